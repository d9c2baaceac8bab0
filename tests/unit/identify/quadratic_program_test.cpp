#include "host/identify/quadratic_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Numbers in [-1, 1] that repeat.
class Numbers {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }
  MatrixXd matrix(Index rows, Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [this] { return next(); });
  }

 private:
  std::uint64_t state_ = 42;
};

/// The optimum by trying every set of active constraints.
double least_cost(const MatrixXd& H, const VectorXd& g, const MatrixXd& G, const VectorXd& h) {
  double best = std::numeric_limits<double>::infinity();
  const Index size = H.rows(), rows = G.rows();
  for (int set = 0; set < (1 << rows); ++set) {
    std::vector<Index> active;
    for (Index i = 0; i < rows; ++i) {
      if ((set >> i & 1) != 0) active.push_back(i);
    }
    const auto count = static_cast<Index>(active.size());
    if (count > size) continue;
    MatrixXd kkt = MatrixXd::Zero(size + count, size + count);
    VectorXd right(size + count);
    kkt.topLeftCorner(size, size) = H;
    right.head(size) = g;
    for (Index i = 0; i < count; ++i) {
      kkt.row(size + i).head(size) = G.row(active[static_cast<std::size_t>(i)]);
      kkt.col(size + i).head(size) = -G.row(active[static_cast<std::size_t>(i)]).transpose();
      right[size + i] = h[active[static_cast<std::size_t>(i)]];
    }
    const VectorXd x = kkt.fullPivLu().solve(right).head(size);
    if ((G * x - h).minCoeff() < -1e-9) continue;
    best = std::min(best, 0.5 * x.dot(H * x) - g.dot(x));
  }
  return best;
}

TEST(QuadraticProgram, MatchesTheBestOfAllActiveSets) {
  Numbers numbers;
  for (int trial = 0; trial < 200; ++trial) {
    const Index size = 2 + trial % 4, rows = 1 + trial % 6;
    const MatrixXd root = numbers.matrix(size + 2, size);
    const MatrixXd H = root.transpose() * root + 1e-3 * MatrixXd::Identity(size, size);
    const VectorXd g = 3 * numbers.matrix(size, 1);
    const MatrixXd G = numbers.matrix(rows, size);
    const VectorXd h = G * numbers.matrix(size, 1) - VectorXd::Constant(rows, 0.1);  // feasible
    const QuadraticSolution solution = minimise(H, g, G, h);
    EXPECT_TRUE(solution.converged);
    EXPECT_LT(solution.kkt.greatest(), 1e-7) << trial;
    const double cost = 0.5 * solution.x.dot(H * solution.x) - g.dot(solution.x);
    EXPECT_NEAR(cost, least_cost(H, g, G, h), 1e-7 * (1 + std::abs(cost))) << trial;
  }
}

TEST(QuadraticProgram, TheResidualSeesAPointThatIsNotOptimal) {
  const MatrixXd H = MatrixXd::Identity(2, 2), G = MatrixXd::Identity(2, 2);
  const VectorXd g = VectorXd::Constant(2, -1), h = VectorXd::Constant(2, 0.5);
  const QuadraticSolution solution = minimise(H, g, G, h);
  EXPECT_LT(solution.kkt.greatest(), 1e-10);
  EXPECT_NEAR((solution.x - h).norm(), 0, 1e-10);
  EXPECT_GT(kkt_residual(H, g, G, h, VectorXd::Constant(2, 1.0), solution.multipliers).greatest(), 0.1);
  EXPECT_GT(kkt_residual(H, g, G, h, VectorXd::Zero(2), solution.multipliers).primal, 0.1);
  EXPECT_GT(kkt_residual(H, g, G, h, solution.x, VectorXd::Zero(2)).stationarity, 0.5);
}

}  // namespace
}  // namespace cartwright
