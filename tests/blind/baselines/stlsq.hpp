#pragma once

#include <Eigen/Dense>
#include <vector>

namespace cartwright::blind {

/// A least-squares problem by its sums: A'A, A'b, b'b and the number of rows. Sums of two problems with the
/// same columns add.
struct NormalEquations {
  Eigen::MatrixXd gram;
  Eigen::VectorXd moment;
  double square = 0, rows = 0;

  explicit NormalEquations(Eigen::Index columns)
      : gram(Eigen::MatrixXd::Zero(columns, columns)), moment(Eigen::VectorXd::Zero(columns)) {}
  void add_row(const Eigen::VectorXd& row, double right);  ///< into the lower half; see `mirror`
  void mirror();                                           ///< fills the upper half, after the last row
  NormalEquations& operator+=(const NormalEquations& other);
  /// Sum of squares left by these coefficients.
  double left(const Eigen::VectorXd& coefficients) const;
};

/// Sequentially thresholded least squares (Brunton, Proctor and Kutz 2016, with the small ridge of Rudy et
/// al. 2017): fit, drop the columns that contribute less than `threshold` (root mean square of the column
/// times its coefficient, in units of the right side's), fit the rest, until none is dropped. The first
/// `kept` columns are never dropped. Dropped coefficients are 0.
Eigen::VectorXd stlsq(const NormalEquations& problem, double threshold, Eigen::Index kept);

/// The same with the threshold chosen by cross-validation over the parts, the largest whose error is within
/// one standard error of the least, then fitted to all of them.
Eigen::VectorXd stlsq_cross_validated(const std::vector<NormalEquations>& parts, Eigen::Index kept);

}  // namespace cartwright::blind
