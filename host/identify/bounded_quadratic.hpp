#pragma once

#include <Eigen/Dense>

namespace cartwright {

struct BoundedSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  ///< H x - g where a bound holds x: >= 0 at a lower one, <= 0 at an upper one
  bool converged = false;
};

/// Minimises  1/2 x' H x - g' x  subject to  lower <= x <= upper  (infinite: no bound), H symmetric and
/// positive semidefinite. Active set in the primal (Stark and Parker 1995): only entries off their bounds are
/// solved for, so that it holds where H as a whole is numerically singular and the bounds make the problem
/// well posed - hundreds of damping values from one response. A dual method, which starts from the
/// unbounded minimum, does not.
BoundedSolution minimise_within(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace cartwright
