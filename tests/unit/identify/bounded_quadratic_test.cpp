#include "host/identify/bounded_quadratic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "host/identify/integral_form.hpp"
#include "host/identify/quadratic_program.hpp"

namespace cartwright {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(BoundedQuadratic, MeetsTheOptimalityConditionsOfRandomProblems) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index size = 2 + trial % 12;
    const auto draw = [&] { return normal(random); };
    const MatrixXd A = MatrixXd::NullaryExpr(size + 1, size, draw);
    const MatrixXd H = A.transpose() * A;
    const VectorXd g = 3 * VectorXd::NullaryExpr(size, draw);
    VectorXd lower = VectorXd::NullaryExpr(size, draw) - VectorXd::Constant(size, 0.5);
    VectorXd upper = lower + VectorXd::Ones(size);
    if (trial % 3 == 0) upper[0] = std::numeric_limits<double>::infinity();
    if (trial % 5 == 0) lower[1] = -std::numeric_limits<double>::infinity();
    const BoundedSolution found = minimise_within(A, VectorXd::Zero(size + 1), g, lower, upper);
    ASSERT_TRUE(found.converged) << trial;
    const VectorXd gradient = H * found.x - g;
    for (Eigen::Index i = 0; i < size; ++i) {
      ASSERT_GE(found.x[i], lower[i] - 1e-12);
      ASSERT_LE(found.x[i], upper[i] + 1e-12);
      const double room_below = found.x[i] - lower[i], room_above = upper[i] - found.x[i];
      if (room_below > 1e-9) {
        ASSERT_LE(gradient[i], 1e-8 * g.norm()) << trial;
      }
      if (room_above > 1e-9) {
        ASSERT_GE(gradient[i], -1e-8 * g.norm()) << trial;
      }
    }
  }
}

/// y'' + (0.9 + 0.7 t) y' + 30 y = 0, Eq. (30)-(32) of the paper, by Runge-Kutta steps finer than the
/// samples.
struct PaperExample {
  std::vector<double> t_s, y_m;
  PaperExample(double error_m) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> error(-error_m, error_m);
    double y = 2, v = -1;
    constexpr int kSteps = 55000, kPerSample = 10;
    constexpr double kStep_s = 0.55 / kSteps;
    const auto rate = [](double t, double at_m, double v_m_per_s) {
      return -(0.9 + 0.7 * t) * v_m_per_s - 30 * at_m;
    };
    for (int i = 0; i <= kSteps; ++i) {
      const double t = kStep_s * i, h = kStep_s;
      if (i % kPerSample == 0) {
        t_s.push_back(t);
        y_m.push_back(y + (error_m > 0 ? error(random) : 0));
      }
      const double a1 = rate(t, y, v), v2 = v + h / 2 * a1;
      const double a2 = rate(t + h / 2, y + h / 2 * v, v2), v3 = v + h / 2 * a2;
      const double a3 = rate(t + h / 2, y + h / 2 * v2, v3), v4 = v + h * a3;
      const double a4 = rate(t + h, y + h * v3, v4);
      y += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
  }
  double damping_error(std::size_t intervals, std::optional<double> slope) const {
    DampingConstraints constraints;
    constraints.greatest_slope_per_s2 = slope;
    const PiecewiseFit fit = PiecewiseForm({t_s, y_m, {}}, intervals).fit(constraints);
    if (slope) {
      EXPECT_LT(fit.solution.kkt.greatest(), 1e-8) << intervals;
    }
    double worst = 0;
    for (std::size_t i = 0; i < intervals; ++i) {
      const double middle_s = 0.55 * (static_cast<double>(i) + 0.5) / static_cast<double>(intervals);
      worst = std::max(worst, std::abs(fit.damping_per_s[i] - (0.9 + 0.7 * middle_s)));
    }
    return worst;
  }
};

TEST(Theorem1, WithoutTheSlopeBoundDampingIsLostAsIntervalsGrowWithItItIsHeld) {
  const PaperExample data(0.002);
  EXPECT_GT(data.damping_error(100, {}), 50 * data.damping_error(5, {}));
  for (const std::size_t k : {5u, 20u, 100u, 200u}) EXPECT_LT(data.damping_error(k, 0.7), 0.6) << k;
}

TEST(Corollary2, FromExactDataTheBoundedDampingConverges) {
  const PaperExample exact(0);
  EXPECT_LT(exact.damping_error(50, 0.7), 0.6 * exact.damping_error(10, 0.7));
  EXPECT_LT(exact.damping_error(200, 0.7), 0.3 * exact.damping_error(50, 0.7));
}

}  // namespace
}  // namespace cartwright
