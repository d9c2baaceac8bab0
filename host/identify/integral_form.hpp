#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "host/identify/interval_sums.hpp"
#include "host/identify/quadratic_program.hpp"

namespace cartwright {

/// Constant damping (Eq. 51-53): y(t) = y0 + alpha0 t - c I(t) - k J(t) in least squares, I = int y, J = int
/// int s.
struct ConstantFit {
  double start_m = 0;        ///< y0
  double alpha_m_per_s = 0;  ///< y'(0) + c y(0)
  double damping_per_s = 0;  ///< c
  double stiffness = 0;      ///< k
};

/// One pass over the samples and a 4 x 4 solution; no allocation.
ConstantFit fit_constant(const IntegralData& data);

/// Inequalities between neighbouring damping values.
struct DampingConstraints {
  std::optional<double> least_rise_per_s;     ///< Eq. (65) as it must read: c(i+1) - c(i) >= d (ERRATA)
  std::optional<double> greatest_rise_per_s;  ///< c(i+1) - c(i) <= this; Eq. (65) as printed with -d
  std::optional<double>
      greatest_slope_per_s2;  ///< Eq. (47): |c(i+1) - c(i)| / dt <= alpha, dt = T_end/n (ERRATA)
};

/// Damping constant over each of n equal intervals, y and y' continuous across them.
struct PiecewiseFit {
  std::vector<double> damping_per_s;  ///< c_1 ... c_n
  double stiffness = 0;               ///< k
  double start_m = 0, alpha_m_per_s = 0;
  std::vector<std::size_t> boundaries;  ///< rows at which intervals start, and one past the last row
  Eigen::VectorXd unknowns;             ///< y0, alpha0, c_1 ... c_n, k
  QuadraticSolution solution;           ///< with the proof of optimality
};

/// Eq. (13)-(29). The 2n - 2 continuity constraints are linear and are eliminated exactly: y_i and alpha_i
/// follow from y0, alpha0, c_1 ... c_n, k by recursion, so that n + 3 unknowns remain. One pass over the
/// samples.
class PiecewiseForm {
 public:
  PiecewiseForm(const IntegralData& data, std::size_t intervals);

  PiecewiseFit fit(const DampingConstraints& constraints = {}) const;

  /// The fit with the right side moved by `shift` (resampling).
  QuadraticSolution solve(const DampingConstraints& constraints, const Eigen::VectorXd& shift) const;

  /// Fitted y at every sample.
  std::vector<double> predict(const Eigen::VectorXd& unknowns) const;

  /// X' e per block of samples, e the residuals at `unknowns`.
  std::vector<Eigen::VectorXd> block_gradients(const Eigen::VectorXd& unknowns, double block_s) const;

  std::size_t intervals() const { return boundaries_.size() - 1; }
  const std::vector<std::size_t>& boundaries() const { return boundaries_; }

 private:
  /// |X x - y|^2 = |R x - right|^2 + what no x changes, without ever squaring the condition of X.
  struct Factored {
    Eigen::MatrixXd R;
    Eigen::VectorXd right;
  };
  Factored factored() const;

  template <typename Visit>
  void each_sample_of(std::size_t interval, Visit&& visit) const;

  /// Calls visit(interval, W): (y, alpha, c, k) at the start of an interval are W times the unknowns.
  template <typename Visit>
  void each_interval(Visit&& visit) const;

  IntegralData data_;
  std::vector<std::size_t> boundaries_;
  std::vector<RunningIntegrals> at_end_;  ///< of each interval
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
};

}  // namespace cartwright
