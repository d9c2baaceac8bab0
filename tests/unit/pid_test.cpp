// The PID law by what it must do: PD without Ki, a running sum with it, and no winding up at the limit.
#include "common/control/pid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

constexpr double kPeriod_s = 1e-3;

TEST(PidController, WithoutAnIntegralGainIsThePdLawToTheBit) {
  PidController pid({{60, 2, 50, false}, 0}, kPeriod_s, 12);
  PdController pd({60, 2, 50, false}, kPeriod_s, 12);
  for (int tick = 0; tick < 500; ++tick) {
    const double y = 0.05 * std::sin(0.03 * tick), d = 0.5 * std::cos(0.1 * tick);
    EXPECT_EQ(pid.update(0.1, y, d), pd.update(0.1, y, d));
  }
}

TEST(PidController, AConstantErrorGrowsBySumTimesGainThisTickIncluded) {
  PidController pid({{0, 0, 50, false}, 10}, kPeriod_s, 12);
  for (int tick = 1; tick <= 100; ++tick) EXPECT_NEAR(pid.update(0.2, 0), 10 * 0.2 * kPeriod_s * tick, 1e-12);
  pid.reset();
  EXPECT_NEAR(pid.update(0.2, 0), 10 * 0.2 * kPeriod_s, 1e-15);
}

TEST(PidController, StopsIntegratingAtTheLimitAndLeavesItAtOnce) {
  PidController pid({{100, 0, 50, false}, 1000}, kPeriod_s, 12);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_EQ(pid.update(1, 0), 12);
  EXPECT_EQ(pid.integral_m_s(), 0);
  EXPECT_LT(pid.update(0.01, 0), 2);
}

TEST(PidController, LeavesTheLimitOnTheOtherSideToo) {
  PidController pid({{100, 0, 50, false}, 1000}, kPeriod_s, 12);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_EQ(pid.update(-1, 0), -12);
  EXPECT_GT(pid.update(-0.01, 0), -2);
}

}  // namespace
}  // namespace cartwright
