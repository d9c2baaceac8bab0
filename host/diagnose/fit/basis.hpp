#pragma once

#include <Eigen/Dense>

#include "host/diagnose/fit/fit.hpp"

namespace cartwright {

/// What a fit's own numbers can explain, and the errors they cannot. Regressions for something the model
/// lacks project their columns out of it first: the model's numbers are then refitted alongside.
struct Basis {
  Eigen::MatrixXd q;       ///< orthonormal columns that span the fit's Jacobian
  Eigen::VectorXd e;       ///< counted errors, outliers clipped, less what `q` explains [m]
  double rows = 0;         ///< that count (Fit::rows)
  double squares_m2 = 0;   ///< sum of the squares of `e`
  double variance_m2 = 0;  ///< mean square of `e`, no less than rounding leaves
  double least_mean_square_m2 = 0;

  /// Log-likelihood that is gained where the squares of `e` add up to no more than so much.
  double gain(double left_m2) const;

  /// Takes out of vectors or columns what the fit's own numbers explain.
  template <typename Columns>
  void project_out(Columns& columns) const {
    columns -= q * (q.transpose() * columns);
  }
};

Basis basis_of(const Fit& fit, double outlier_m);

/// Standard deviation of a normal variable from the median size of a fit's errors, which outliers do not
/// move, and no less than rounding leaves: where a cart mostly stands the median is nought.
double robust_size(const Fit& fit);

}  // namespace cartwright
