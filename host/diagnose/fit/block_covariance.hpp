#pragma once

#include <Eigen/Dense>
#include <vector>

namespace cartwright {

/// What a stretch of time says about the parameters of a least-squares fit: the sums of slope times error and
/// of slope times slope of its rows.
struct Block {
  Eigen::VectorXd score;
  Eigen::MatrixXd information;
};

/// Covariance of the parameters from how far each block moves them,
///
///     C = sum_b d_b d_b^T,   d_b = (H - A_b)^-1 s_b,   H = sum_b A_b,
///
/// the jackknife over blocks: it holds whatever the errors within a block have in common, and a block that
/// bent the fit towards itself counts as if it had not. A block is taken to hold half of what is known about
/// any number at most: what one block alone knows of, no other can judge.
///
/// Few blocks know of a number that acts for a moment only, and their scores are too small once it is fitted:
/// no variance is taken to be less than errors of `white_variance`, if they were white, would leave.
Eigen::MatrixXd block_covariance(const std::vector<Block>& blocks, double white_variance);

}  // namespace cartwright
