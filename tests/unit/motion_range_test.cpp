#include "host/session/motion_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace cartwright {
namespace {

Recording moving(const std::function<double(double t_s)>& position, int rows, double period_s = 1e-3) {
  Recording r;
  for (int k = 0; k < rows; ++k) {
    r.t_s.push_back(k * period_s);
    r.y_m.push_back(position(r.t_s.back()));
  }
  return r;
}

TEST(MotionRange, OfASineIsItsHeightAndItsSpeed) {
  const Recording sine = moving([](double t) { return 0.1 * std::sin(6 * t); }, 10000);
  const MotionRange range = motion_range_of({&sine, 1});
  EXPECT_NEAR(range.travel_m(), 0.2, 1e-3);
  EXPECT_NEAR(range.most_speed_m_per_s, 0.6, 0.01);
  EXPECT_NEAR(range.typical_speed_m_per_s, 0.6 / std::sqrt(2), 0.01);
}

TEST(MotionRange, RowsThatAreMissingDoNotSlowItDown) {
  Recording ramp = moving([](double t) { return 0.3 * t; }, 2000);
  for (std::size_t k = 1000; k < ramp.size(); ++k) ramp.t_s[k] += 60;
  EXPECT_NEAR(motion_range_of({&ramp, 1}).most_speed_m_per_s, 0.3, 1e-6);
}

TEST(MotionRange, ACartThatHardlyEverMovesHasASpeed) {
  const Recording once = moving([](double t) { return t < 0.02 ? t : 0.02; }, 10000);
  EXPECT_GT(motion_range_of({&once, 1}).most_speed_m_per_s, 0.01);
}

TEST(MotionRange, OfNothingIsZero) {
  EXPECT_EQ(motion_range_of({}).travel_m(), 0);
  const Recording one = moving([](double) { return 1.0; }, 1);
  EXPECT_EQ(motion_range_of({&one, 1}).most_speed_m_per_s, 0);
}

}  // namespace
}  // namespace cartwright
