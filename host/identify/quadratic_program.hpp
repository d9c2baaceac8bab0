#pragma once

#include <Eigen/Dense>

namespace cartwright {

/// How far a point is from the optimum of a quadratic programme: the greatest of the residuals of the
/// Karush-Kuhn-Tucker conditions, each relative to the size of what it balances. For a convex programme, zero
/// proves the optimum.
struct KktResidual {
  double stationarity = 0;     ///< |H x - g - G' lambda|
  double primal = 0;           ///< violation of G x >= h
  double dual = 0;             ///< negative part of lambda
  double complementarity = 0;  ///< |lambda (G x - h)|

  double greatest() const;
};

struct QuadraticSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd multipliers;  ///< lambda >= 0, one per row of G; positive where the bound holds the point
  KktResidual kkt;
  bool converged = false;
};

/// Minimises  1/2 x' H x - g' x  subject to  G x >= h,  H symmetric positive definite. Solved in the dual, a
/// non-negative least-squares problem in the multipliers, by the active-set method of Lawson and Hanson
/// (1974).
QuadraticSolution minimise(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, const Eigen::MatrixXd& G,
                           const Eigen::VectorXd& h);

/// The residuals of a candidate solution, from the programme alone.
KktResidual kkt_residual(const Eigen::MatrixXd& H, const Eigen::VectorXd& g, const Eigen::MatrixXd& G,
                         const Eigen::VectorXd& h, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& multipliers);

}  // namespace cartwright
