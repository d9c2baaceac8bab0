#pragma once

#include <functional>
#include <vector>

#include "common/model/model.hpp"
#include "common/result.hpp"
#include "host/identify/force_units.hpp"
#include "host/identify/motion.hpp"
#include "host/identify/regressors.hpp"
#include "host/identify/weak_form.hpp"
#include "host/session/session.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

struct IdentifyOptions {
  WeakFormOptions weak;
  MotionOptions motion;
  bool instruments = true;                ///< use a simulated twin where the control law is known
  int draws = 500;                        ///< resamplings behind the intervals
  std::optional<ForceScale> force_scale;  ///< report forces as well
  std::function<void(double)> progress;   ///< hears which part of the search for shapes is done
};

/// One number of the model; its interval is left open where the data gives none.
struct ParameterEstimate {
  Parameter parameter = Parameter::voltage_gain;
  Estimate estimate;
  bool at_bound = false;  ///< the best value lies at the edge of what the model may hold
};

struct Identification {
  Model model;
  std::vector<ParameterEstimate> estimates;
  std::vector<ForceEstimate> forces;     ///< the same times the moving mass, where a scale is given
  std::vector<Parameter> not_separable;  ///< this data fixes these only in combination
  std::size_t windows = 0;               ///< equations
  double residual_m_per_s2 = 0;          ///< rms of what the model leaves of the weak acceleration
  double acceleration_m_per_s2 = 0;      ///< rms of the weak acceleration itself
  std::size_t twins = 0;                 ///< recordings whose twin served as instrument
  std::size_t units = 0;                 ///< blocks that were resampled
};

/// The integral method in its recorded-voltage form, for any reference and any number of recordings at once:
///
///     integral p y'' dt = sum_j theta_j integral p g_j(y, v, u, t) dt
///
/// over short windows with a smooth test function p (bump.hpp), linear in theta and solved by least squares.
/// This is the double integral of Eq. (8) of Wongvanich, Hann and Sirisena (2015) with the recorded voltage
/// in the place of the spring (ERRATA, Sec. 2.2) and without its start states: p takes them out.
///
/// 1. Stretches in which the cart sticks are left out, gaps are never crossed (motion.hpp).
/// 2. Shapes that act nonlinearly (speeds, periods, delays) are searched for around the linear solution.
/// 3. Coefficients that may not be negative are held at zero by an active-set solver, and flagged.
/// 4. Where the control law is known, the model is run in closed loop without noise, and the twin's columns
/// serve as
///    instruments: Z' X theta = Z' b. They know nothing of the disturbance that the controller fed back into
///    u.
/// 5. Intervals by resampling blocks of about a second, and whole recordings where there are six or more; the
/// wider
///    of the two is reported.
///
/// Fails where nothing moves, or too little to give as many equations as there are unknowns.
Result<Identification> identify(const Session& session, const TermSet& terms,
                                const IdentifyOptions& options = {});

}  // namespace cartwright
