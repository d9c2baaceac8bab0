#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/identify/identify.hpp"
#include "host/session/session.hpp"

namespace cartwright {

struct SimulationFitOptions {
  std::vector<Parameter> held;           ///< numbers of the model to keep as given
  unsigned threads = 1;                  ///< trial simulations at the same time
  std::function<void(double)> progress;  ///< hears which part of the work is done
};

struct SimulationFit {
  Model model;
  std::vector<ParameterEstimate> estimates;  ///< of the numbers that were fitted
  std::vector<Parameter> held;               ///< numbers of the model that stayed as given
  std::vector<Parameter> not_separable;      ///< these recordings fix them only in combination, or not at all
  double before_m = 0;               ///< rms error of whole recordings simulated with the model given [m]
  double after_m = 0;                ///< and with the model fitted [m]
  std::optional<double> held_out_m;  ///< rms error over second halves of a fit to first halves [m]
  std::size_t rows = 0;              ///< readings compared
};

/// Refits the numbers of a model by simulating whole recordings from their voltage (output error): minimises
///
///     J(theta) = sum over recordings, rows k >= 20 of (y(k) - yhat(k; theta, y(0), v(0)))^2        [m^2]
///
/// where yhat is the cart under the recorded voltage, friction sticking exactly, and its start state is the
/// one that fits the first 20 rows. That is the error which `evaluate` calls open loop. What acts slowly adds
/// up in it: a constant push wrong by a moves the cart by a t/c after a time t, so this error tells pushes
/// and the difference between directions far better than errors over short times do, and the drive's gain and
/// what happens fast worse. It decides no names: the terms are those of `start`.
///
/// Fitted are the gain, frictions, pushes, spring, drag and dead zone; periods, delays, masses and events
/// stay as given. Levenberg-Marquardt with central differences, wide ones first because sticking makes J
/// uneven; numbers that may not be negative are held at zero.
///
/// Errors of one simulation belong together from the first row to the last, so that only recordings are
/// independent: the intervals are those of a jackknife over recordings (one linearised step for each left
/// out), and open where there are fewer than four. What the fit is worth elsewhere is told by `held_out_m`.
///
/// Where a model lacks physics this error takes in whatever of it these recordings hold: that carries over to
/// recordings along the same references, and less to others (README). Errors over short times grow.
///
/// Fails where no recording is long enough, the given model's simulation runs away, or nothing moves.
Result<SimulationFit> fit_by_simulation(const Session& session, const Model& start,
                                        const SimulationFitOptions& options = {});

}  // namespace cartwright
