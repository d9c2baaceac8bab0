#pragma once

#include <span>
#include <string>
#include <vector>

namespace cartwright {

/// A step response to fit, and its model: e'' + C(t) e' + beta Kp e = 0, C constant over each of n equal
/// intervals, e and e' continuous across them (Wongvanich, Hann and Sirisena 2015, Eq. 4-7, 60-62).
struct RegressionData {
  std::span<const double> t_s, e_m;
  double kp_V_per_m = 0;
};

/// How the model's response is computed in every iteration.
enum class ResponseBy {
  analytical,  ///< Eq. (86), (90)-(92) with the interval starting at T_(i-1) (ERRATA)
  integrated,  ///< Runge-Kutta of the differential equation from sample to sample
  adaptive,    ///< the paper's way: adaptive steps (ode45), derivatives by differences
};

/// What is searched for: n damping values, beta, and the state at the start.
struct RegressionPoint {
  std::vector<double> damping_per_s;
  double beta = 0;
  double start_m = 0, start_m_per_s = 0;
};

/// A start with the same damping everywhere; the state from the first reading, at rest.
RegressionPoint regression_start(const RegressionData& data, std::size_t intervals, double damping_per_s,
                                 double beta);

struct RegressionFit {
  RegressionPoint point;
  double rms_m = 0, mean_absolute_m = 0;  ///< of response less measured
  double time_s = 0;                      ///< wall clock of the whole fit
  double evaluation_share = 0;            ///< of it in residuals and Jacobians
  int iterations = 0, evaluations = 0;
  bool converged = false;
  std::string message;
};

/// Ordinary non-linear least squares: Levenberg-Marquardt of Ceres, with exact derivatives (automatic
/// differentiation) where the response is `analytical` or `integrated`. For comparison with the integral
/// method only; one or six intervals.
RegressionFit fit_by_regression(const RegressionData& data, const RegressionPoint& start, ResponseBy by);

/// The response of a point at the samples' times.
std::vector<double> regression_response(const RegressionData& data, const RegressionPoint& point,
                                        ResponseBy by);

}  // namespace cartwright
