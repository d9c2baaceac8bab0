#include "host/statistics/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "host/statistics/autocorrelation.hpp"

namespace cartwright {
namespace {

TEST(Distributions, AgreeWithClosedForms) {
  // One degree of freedom is the Cauchy distribution, two have an algebraic quantile, F(2, n) is elementary.
  for (const double p : {0.5, 0.9, 0.95, 0.99}) {
    EXPECT_NEAR(student_t(p, 1), std::tan(0.5 * std::numbers::pi * p), 1e-9 / (1 - p));
    EXPECT_NEAR(student_t(p, 2), p * std::sqrt(2 / (1 - p * p)), 1e-9);
    for (const double n : {4.0, 30.0}) {
      EXPECT_NEAR(f_quantile(p, 2, n), 0.5 * n * (std::pow(1 - p, -2 / n) - 1), 1e-9);
    }
    EXPECT_NEAR(std::erf(normal(p) / std::numbers::sqrt2), p, 1e-14);
  }
}

TEST(Distributions, StudentIsSmoothWhereTheMethodChangesAndTendsToNormal) {
  EXPECT_NEAR(student_t(0.95, 60), student_t(0.95, 60.0001), 1e-6);
  EXPECT_NEAR(student_t(0.99, 60), student_t(0.99, 60.0001), 1e-6);
  EXPECT_NEAR(student_t(0.95, 1e9), normal(0.95), 1e-8);
}

TEST(Distributions, IncompleteBetaIsSymmetricAndComplete) {
  EXPECT_NEAR(incomplete_beta(2.5, 4, 0.3), 1 - incomplete_beta(4, 2.5, 0.7), 1e-13);
  EXPECT_NEAR(incomplete_beta(1, 3, 0.2), 1 - std::pow(0.8, 3), 1e-13);
  EXPECT_EQ(incomplete_beta(3, 2, 0), 0);
  EXPECT_EQ(incomplete_beta(3, 2, 1), 1);
}

TEST(Autocorrelation, CountsAsManyErrorsAsOneAsTheirCorrelationTimeHolds) {
  // A first-order process, e(k) = a e(k-1) + noise: the sum of a^|lag| over all lags is (1 + a)/(1 - a).
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal_draw;
  for (const double a : {0.0, 0.5, 0.9}) {
    Eigen::VectorXd e = Eigen::VectorXd::Zero(40000);
    for (Eigen::Index k = 1; k < e.size(); ++k) e[k] = a * e[k - 1] + normal_draw(random);
    const double expected = (1 + a) / (1 - a);
    EXPECT_NEAR(errors_per_independent_one(e), expected, 0.15 * expected) << a;
  }
  EXPECT_EQ(errors_per_independent_one(Eigen::VectorXd::Zero(100)), 1);
}

}  // namespace
}  // namespace cartwright
