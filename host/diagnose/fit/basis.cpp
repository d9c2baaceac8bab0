#include "host/diagnose/fit/basis.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {

Basis basis_of(const Fit& fit, double outlier_m) {
  const auto rows = static_cast<Eigen::Index>(fit.error_m.size());
  Basis basis;
  basis.e = Eigen::Map<const Eigen::VectorXd>(fit.error_m.data(), rows);
  if (outlier_m > 0) basis.e = basis.e.cwiseMin(outlier_m).cwiseMax(-outlier_m);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fit.jacobian);
  basis.q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, fit.jacobian.cols());
  basis.project_out(basis.e);
  basis.least_mean_square_m2 = fit.least_mean_square_m2;
  basis.rows = fit.rows;
  basis.squares_m2 = basis.e.squaredNorm();
  basis.variance_m2 = noise_variance_m2(basis.squares_m2, basis.rows, basis.least_mean_square_m2);
  return basis;
}

double Basis::gain(double left_m2) const {
  return log_likelihood(left_m2, rows, least_mean_square_m2) -
         log_likelihood(squares_m2, rows, least_mean_square_m2);
}

double robust_size(const Fit& fit) {
  std::vector<double> sizes;
  sizes.reserve(fit.error_m.size());
  for (const double e : fit.error_m) {
    if (e != 0) sizes.push_back(std::abs(e));  // of a cart at rest they are zero
  }
  if (sizes.empty()) return std::sqrt(fit.least_mean_square_m2);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(1.4826 * *middle, std::sqrt(fit.least_mean_square_m2));
}

}  // namespace cartwright
