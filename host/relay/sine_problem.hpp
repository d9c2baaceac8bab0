#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace cartwright {

/// Samples prepared for fitting
///
///     y = offset + trend x + sum over k = 1 ... K of (a_k cos 2 pi k f tau + b_k sin 2 pi k f tau)
///
/// with tau the time from the middle of the record and x = tau/half_span in [-1, 1]: centred and scaled, so
/// that the normal equations are as well conditioned as the data allows.
class SineProblem {
 public:
  SineProblem(std::span<const double> t_s, std::span<const double> y, int harmonics);

  /// The linear least-squares solution at one frequency and what a Gauss-Newton step of the frequency needs.
  struct Point {
    double frequency_hz = 0;
    Eigen::VectorXd linear;      ///< offset, [trend], a_1, b_1, ... a_K, b_K
    double cost = 0;             ///< sum of squared residuals
    double step_rad = 0;         ///< Gauss-Newton step of 2 pi f half_span
    Eigen::MatrixXd covariance;  ///< of (linear, 2 pi f half_span) for unit noise variance
  };

  /// One pass over the samples. All columns are products of the same block, so that one pass gives the
  /// solution, its cost and the step (variable projection, Kaufman's form).
  Eigen::MatrixXd products(double frequency_hz) const;
  Point solve(double frequency_hz, const Eigen::MatrixXd& products, bool with_trend) const;
  Point at(double frequency_hz, bool with_trend) const {
    return solve(frequency_hz, products(frequency_hz), with_trend);
  }

  /// Cost of offset alone, or of offset and trend.
  double cost_without_sine(bool with_trend) const;

  std::vector<double> residual(const Point& point, bool with_trend) const;

  std::size_t size() const { return tau_s_.size(); }
  int harmonics() const { return harmonics_; }
  double centre_s() const { return centre_s_; }
  double half_span_s() const { return half_span_s_; }
  double mean() const { return mean_; }
  const std::vector<double>& tau_s() const { return tau_s_; }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }  ///< less its mean

 private:
  Eigen::MatrixXd products_of_fundamental(double frequency_hz) const;

  int harmonics_;
  double centre_s_ = 0, half_span_s_ = 1, mean_ = 0;
  std::vector<double> tau_s_, x_, y_;
  Eigen::Matrix3d base_;  ///< products of (1, x, y)
};

/// cos and sin of 2 pi times `cycles`, for each of `count` values; error below 1.5e-15. Vectorises.
void cosine_and_sine_of_cycles(const double* cycles, std::size_t count, double* cosine, double* sine);

}  // namespace cartwright
