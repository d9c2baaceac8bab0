#include "host/diagnose/search/evolution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

using Eigen::VectorXd;

/// A narrow valley, turned out of the axes, a hundred times as long as wide, with its least at `bottom`.
double valley(const VectorXd& x, const VectorXd& bottom) {
  const VectorXd from = x - bottom;
  double cost = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double turned = i + 1 < x.size() ? from[i] + from[i + 1] : from[i] - from[0];
    cost += std::pow(10, 4.0 * static_cast<double>(i) / static_cast<double>(x.size() - 1)) * turned * turned;
  }
  return cost;
}

VectorXd bottom(Eigen::Index n) {
  return VectorXd::LinSpaced(n, -1.5, 2);
}

TEST(Evolution, FollowsANarrowValleyToItsEnd) {
  const auto cost = [](const VectorXd& x) { return valley(x, bottom(8)); };
  const VectorXd found = evolve(cost, VectorXd::Zero(8), {4000, 1, 1});
  EXPECT_LT((found - bottom(8)).norm(), 1e-3);
}

/// Wherever a descent starts, a local best lies within a tenth in each coordinate; the search ends that near
/// to the best of all.
TEST(Evolution, IsNotStoppedByRipplesAndSteps) {
  const auto cost = [](const VectorXd& x) {
    const VectorXd from = x - bottom(6);
    double sum = 0;
    for (const double d : from) sum += d * d + 0.05 * (1 - std::cos(2 * M_PI * d / 0.1));
    return std::floor(1e3 * sum) / 1e3;
  };
  const VectorXd found = evolve(cost, VectorXd::Zero(6), {3000, 1, 1});
  EXPECT_LT((found - bottom(6)).cwiseAbs().maxCoeff(), 0.3);
}

TEST(Evolution, ComesOutTheSameForAnyNumberOfThreads) {
  const auto cost = [](const VectorXd& x) { return valley(x, bottom(5)); };
  EXPECT_EQ(evolve(cost, VectorXd::Zero(5), {500, 1, 3}), evolve(cost, VectorXd::Zero(5), {500, 3, 3}));
}

TEST(Evolution, NeverEndsWorseThanItBegan) {
  const auto cost = [](const VectorXd& x) { return x.norm(); };
  EXPECT_EQ(evolve(cost, VectorXd::Zero(4), {200, 1, 1}), VectorXd::Zero(4));
}

}  // namespace
}  // namespace cartwright
