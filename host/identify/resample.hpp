#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace cartwright {

/// What one unit of resampling (a block of a recording, or a whole recording) adds to the normal equations of
/// Z' J delta = Z' r, with the residuals r at the estimate.
struct ResampleUnit {
  Eigen::MatrixXd information;  ///< Z' J
  Eigen::VectorXd gradient;     ///< Z' r
};

/// Draws units with replacement and returns one step delta away from the estimate per row. The normal
/// equations add up, so a draw costs no pass over the data. The seed is fixed: the same recordings give the
/// same interval.
Eigen::MatrixXd resample(const std::vector<ResampleUnit>& units, int draws, std::uint64_t seed = 1);

/// Sums of the gradients with random signs, one per draw (wild bootstrap): for residuals of one series whose
/// blocks cannot change places.
std::vector<Eigen::VectorXd> random_signs(const std::vector<Eigen::VectorXd>& gradients, int draws,
                                          std::uint64_t seed = 1);

/// Half of the width between the 2.5 % and 97.5 % quantiles, widened from the normal to Student's t for few
/// units.
double half_width_95(std::vector<double> draws, std::size_t units);

}  // namespace cartwright
