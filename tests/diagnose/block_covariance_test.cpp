#include "host/diagnose/fit/block_covariance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cartwright {
namespace {

/// A mean and a slope fitted to sixty blocks of ten rows; only the last so many know of the slope.
class LineInBlocks {
 public:
  LineInBlocks(int blocks_with_slope, double common) : with_slope_(blocks_with_slope), common_(common) {}

  /// Fits errors of size 1, of which a part is the same for a block, and answers by how many of its standard
  /// errors the slope is off.
  double slope_in_standard_errors(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    Eigen::MatrixXd rows(kBlocks * kRows, 2);
    Eigen::VectorXd y(kBlocks * kRows);
    for (int b = 0; b < kBlocks; ++b) {
      const double shared = common_ * normal(random);
      for (int i = 0; i < kRows; ++i) {
        const bool knows = b >= kBlocks - with_slope_;
        rows.row(b * kRows + i) << 1, knows ? 1.0 + 0.2 * i : 0.0;
        y[b * kRows + i] = shared + std::sqrt(1 - common_ * common_) * normal(random);
      }
    }
    const Eigen::Vector2d found = (rows.transpose() * rows).ldlt().solve(rows.transpose() * y);
    const Eigen::VectorXd errors = rows * found - y;
    std::vector<Block> blocks;
    for (int b = 0; b < kBlocks; ++b) {
      const auto here = rows.middleRows(b * kRows, kRows);
      blocks.push_back({here.transpose() * errors.segment(b * kRows, kRows), here.transpose() * here});
    }
    return found[1] / std::sqrt(block_covariance(blocks, 0)(1, 1));
  }

 private:
  static constexpr int kBlocks = 60, kRows = 10;
  int with_slope_;
  double common_;
};

double share_within_95_percent(const LineInBlocks& line) {
  constexpr int kDraws = 2000;
  std::mt19937_64 random(1);
  int held = 0;
  for (int i = 0; i < kDraws; ++i) held += std::abs(line.slope_in_standard_errors(random)) < 1.96;
  return static_cast<double>(held) / kDraws;
}

TEST(BlockCovariance, IntervalsHoldUnderWhiteErrors) {
  EXPECT_NEAR(share_within_95_percent(LineInBlocks(40, 0)), 0.95, 0.02);
}

TEST(BlockCovariance, IntervalsHoldUnderErrorsThatABlockHasInCommon) {
  EXPECT_NEAR(share_within_95_percent(LineInBlocks(40, 0.8)), 0.95, 0.02);
}

/// Scores of six blocks that bent the fit towards themselves are too small: taken as they are, 87 % hold.
TEST(BlockCovariance, IntervalsHoldWhereFewBlocksKnow) {
  EXPECT_GT(share_within_95_percent(LineInBlocks(6, 0.8)), 0.9);
}

}  // namespace
}  // namespace cartwright
