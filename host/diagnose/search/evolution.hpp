#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>

namespace cartwright {

struct EvolutionOptions {
  int most_evaluations = 1000;
  unsigned threads = 1;  ///< costs asked for at a time; the result is the same for any
  std::uint64_t seed = 1;
};

/// The least of a rugged cost of some ten numbers, looked for from `start` with steps of about 1 in every
/// coordinate: the evolution strategy with an adapted covariance matrix (N. Hansen, The CMA Evolution
/// Strategy: A Tutorial, arXiv 1604.00772, with its weights and rates). It sees only which of a generation of
/// random points cost less, so kinks, corners and rounding, at which a slope misleads, do not stop it.
/// Returns the best point asked for.
Eigen::VectorXd evolve(const std::function<double(const Eigen::VectorXd&)>& cost,
                       const Eigen::VectorXd& start, const EvolutionOptions& options);

}  // namespace cartwright
