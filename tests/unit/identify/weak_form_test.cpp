#include "host/identify/weak_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/identify/motion.hpp"
#include "host/identify/resample.hpp"

namespace cartwright {
namespace {

std::vector<double> jittered(std::size_t rows) {
  std::vector<double> t_s;
  for (std::size_t row = 0; row < rows; ++row) {
    t_s.push_back(1e-3 * static_cast<double>(row) + 2e-4 * std::sin(91.7 * static_cast<double>(row)));
  }
  return t_s;
}

TEST(WeakForm, PositionAndVelocityDoNotLeakIn) {
  const std::vector<double> t_s = jittered(1000);
  const auto windows = place_windows(t_s, {{0, 1000}}, {});
  ASSERT_GT(windows.size(), 30u);
  std::vector<double> y_m;
  for (const double t : t_s) y_m.push_back(1e3 - 50 * t);
  const Eigen::VectorXd acceleration = weak_acceleration(windows, t_s, y_m);
  EXPECT_LT(acceleration.cwiseAbs().maxCoeff(), 1e-6);
}

TEST(WeakForm, BothSidesAgreeForAHeldAcceleration) {
  // y'' held between rows: y at the rows follows exactly, and so must the weak form, whatever the jitter.
  const std::vector<double> t_s = jittered(1000);
  std::vector<double> y_m{0.3};
  Eigen::MatrixXd held(999, 1);
  double velocity = -0.2;
  for (Eigen::Index k = 0; k < 999; ++k) {
    const double h = t_s[static_cast<std::size_t>(k) + 1] - t_s[static_cast<std::size_t>(k)];
    held(k, 0) = 3 * std::cos(0.02 * static_cast<double>(k)) + (k % 7 == 0 ? 2 : 0);
    y_m.push_back(y_m.back() + velocity * h + 0.5 * held(k, 0) * h * h);
    velocity += held(k, 0) * h;
  }
  const auto windows = place_windows(t_s, {{0, 1000}}, {});
  const Eigen::VectorXd left = weak_acceleration(windows, t_s, y_m);
  const Eigen::MatrixXd right = weak_means(windows, t_s, held);
  // Not to rounding: within a row the position bends away from the straight line.
  EXPECT_LT((left - right.col(0)).cwiseAbs().maxCoeff(), 2e-3 * right.cwiseAbs().maxCoeff());
}

TEST(WeakForm, WindowsStayInsideTheirStretches) {
  const std::vector<double> t_s = jittered(1000);
  const std::vector<Segment> stretches{{10, 300}, {310, 340}, {400, 480}};
  std::size_t in_last = 0;
  for (const Window& window : place_windows(t_s, stretches, {})) {
    bool inside = false;
    for (const Segment& stretch : stretches) {
      inside = inside || (window.first >= stretch.first && window.last <= stretch.last);
    }
    EXPECT_TRUE(inside);
    EXPECT_LE(t_s[window.first], window.bump.centre_s - window.bump.half_s + 1e-9);
    EXPECT_GE(t_s[window.last - 1], window.bump.centre_s + window.bump.half_s - 1e-9);
    if (window.first >= 400) ++in_last;
  }
  EXPECT_EQ(in_last, 1u);  // 80 ms: shorter than a window, long enough for one of its own length
}

TEST(Motion, StandingStillBelongsToNoStretch) {
  Recording recording;
  for (int row = 0; row < 2000; ++row) {
    recording.t_s.push_back(1e-3 * row);
    const double moved =
        row < 800 ? 0.1 * 1e-3 * row : (row < 1200 ? 0.08 : 0.08 - 0.1 * 1e-3 * (row - 1200));
    recording.y_m.push_back(2.275e-5 * std::round(moved / 2.275e-5));
    recording.u_V.push_back(0);
  }
  Rig rig;
  rig.encoder_resolution_m = 2.275e-5;
  const Motion motion = motion_of(recording, rig);
  ASSERT_EQ(motion.moving.size(), 2u);
  EXPECT_NEAR(static_cast<double>(motion.moving[0].last), 800, 15);
  EXPECT_NEAR(static_cast<double>(motion.moving[1].first), 1200, 15);
  EXPECT_NEAR(motion.velocity.at_m_per_s[400], 0.1, 2e-3);
  EXPECT_NEAR(motion.velocity.at_m_per_s[1600], -0.1, 2e-3);
  EXPECT_EQ(motion.velocity.direction[1600], -1);
}

TEST(Resample, GivesTheStandardErrorOfAMean) {
  // One unknown, information 1 per unit: the draws are means, with standard error sigma/sqrt(n).
  std::vector<ResampleUnit> units;
  double squares = 0;
  for (int i = 0; i < 400; ++i) {
    const double r = std::sin(1.7 * i * i);
    squares += r * r;
    units.push_back({Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Constant(1, r)});
  }
  const Eigen::MatrixXd draws = resample(units, 4000);
  std::vector<double> values(draws.col(0).begin(), draws.col(0).end());
  EXPECT_NEAR(half_width_95(values, units.size()), 1.96 * std::sqrt(squares) / 400,
              0.06 * 1.96 * std::sqrt(squares) / 400);
}

}  // namespace
}  // namespace cartwright
