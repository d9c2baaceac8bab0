#pragma once

#include <Eigen/Dense>
#include <vector>

#include "host/identify/problem.hpp"

namespace cartwright {

/// The estimate, what is left at it, and how every number moves the prediction.
struct Solution {
  Eigen::VectorXd theta;
  Model model;
  std::vector<Eigen::MatrixXd> jacobian, instruments;  ///< per recording; coefficients first, then shapes
  std::vector<Eigen::VectorXd> residual;
};

/// Puts the estimates with their intervals into `out`. The interval has two parts, added in quadrature: what
/// resampling blocks (and whole recordings) shows, and by how much the estimate moves when the windows are
/// half as long again, which is what a wrong structure or the joining of readings by straight lines does to
/// it.
void add_estimates(const Problem& problem, const TermSet& terms, const Linear& linear, Solution solution,
                   const IdentifyOptions& options, Identification& out);

}  // namespace cartwright
