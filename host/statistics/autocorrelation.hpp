#pragma once

#include <Eigen/Dense>

namespace cartwright {

/// How many neighbouring errors count as one: 1 + 2 (r1 + r2 + ...), their autocorrelation summed up to its
/// first zero, over a quarter of them at most. 1 where they are white.
double errors_per_independent_one(const Eigen::VectorXd& errors);

}  // namespace cartwright
