#pragma once

#include <Eigen/Dense>
#include <vector>

#include "host/diagnose/observe/observer.hpp"

namespace cartwright {

/// One number the fit may move. `scale` is its natural size: finite differences use it. Numbers that span
/// decades (stiffness, speeds, periods, time constants) move by their logarithm.
struct FreeParameter {
  Parameter id;
  double scale;
  double lower, upper;
  bool logarithmic = false;
};

struct FitOptions {
  double outlier_m = 0;  ///< errors beyond this count linearly (Huber); 0: every error counts by its square
  int most_rounds = 4;   ///< rounds of physics, then noise
  int most_iterations = 8;          ///< Levenberg-Marquardt iterations in a round
  double tolerance = 0.1;           ///< stop when the log-likelihood gains less than this
  double finest_noise_step = 0.04;  ///< of the logarithms of the noise, where the pattern search ends
  bool covariance = true;           ///< else `jacobian` and `covariance` stay empty: a pass a number saved
  bool move_noise = true;           ///< fit the observer's noise ratio and correlation time alongside
  double difference_step = 2e-3;    ///< of the finite differences, in units of a parameter's scale
  double step_s = 1e-3;             ///< greatest inner step of the plant
  bool coarsely = false;            ///< as in ObserverOptions
  double damping_per_s = 5;         ///< of the linear cart behind the observer's gain
  double rest_s = 0;                ///< a cart that stays within a count for so long rests (rest.hpp)
  unsigned threads = 1;             ///< of a pass, which then takes so many recordings at a time
};

/// Options for a session and its nominal model: damping and time of rest, the same for all that is compared.
FitOptions options_for(const Session& session, const Model& nominal);

/// A model fitted by the likelihood of its one-step prediction errors,
///
///     log L = -N/2 (log v + S / (N v) - 1),   S = sum rho(e(k)),   v = max(S / N, v_min),
///
/// with the noise size v concentrated out, but never below what rounding the readings leaves: a cart that
/// stands is read without any error, and readings that are trusted for it make the rest of the recording
/// sure of anything. Rows of a cart at rest (rest.hpp) are not among the N; what their errors exceed half a
/// count by adds to S. `covariance` is that of block_covariance.hpp over blocks of time, repeats taken
/// together: it stays honest when errors are coloured or the encoder's steps make them uneven.
struct Fit {
  Model model;
  NoiseModel noise;
  std::vector<FreeParameter> free;
  double log_likelihood = 0;
  double error_rms_m = 0;             ///< sqrt(v)
  double least_mean_square_m2 = 0;    ///< v_min
  double rows = 0;                    ///< errors counted, but for those of a cart at rest
  std::vector<double> error_m;        ///< all counted errors, recordings in order
  std::vector<double> block_loss_m2;  ///< sum of rho(e) per block, in session order
  std::vector<std::size_t> blocks;    ///< of each recording
  Eigen::MatrixXd jacobian;           ///< de/dp of the free parameters, a row per counted error
  Eigen::MatrixXd covariance;         ///< of the free parameters
  bool converged = false;

  double standard_error(Parameter parameter) const;
  /// An optional one at its default is absent, and at no bound.
  bool at_bound(Parameter parameter) const;
};

/// By how much one fit is better than another of the same rows, block by block: the sum of the differences of
/// their losses in units of the better one's noise, and the spread of that sum.
struct PairedDifference {
  double nats = 0, spread = 0;
};
PairedDifference paired_difference(const Fit& better, const Fit& worse);
/// The same of each recording.
std::vector<PairedDifference> differences_by_recording(const Fit& better, const Fit& worse);

/// A `difference_step` for costs with kinks: contact comes and goes.
inline constexpr double kStepOverKinks = 0.05;

/// Length of the blocks that losses and scores are summed over.
inline constexpr double kBlock_s = 0.25;

/// Levenberg-Marquardt over the physics and a pattern search over the noise, in turn, from `start`, within
/// bounds.
Fit fit(const Session& session, const Model& start, const NoiseModel& noise,
        const std::vector<FreeParameter>& free, const FitOptions& options = {});

/// Finds the noise for a fixed model from a coarse grid: the start of the first fit of a session.
NoiseModel search_noise(const Session& session, const Model& model, const FitOptions& options = {});

struct CountedErrors {
  std::vector<double> error_m;  ///< recordings in order
  double rows = 0;              ///< that tell more than that the cart rests (rest.hpp)
  /// What rounding alone leaves, q^2 / 12 times the error variance ratio.
  double least_mean_square_m2 = 0;
};

/// All counted errors of a session.
CountedErrors counted_errors(const Session& session, const Model& model, const NoiseModel& noise,
                             const FitOptions& options = {});

double log_likelihood(const CountedErrors& errors, double outlier_m);

/// The noise size v of so many rows whose rho(e) add up to `sum_m2`, and their log-likelihood.
double noise_variance_m2(double sum_m2, double rows, double least_mean_square_m2);
double log_likelihood(double sum_m2, double rows, double least_mean_square_m2);

}  // namespace cartwright
