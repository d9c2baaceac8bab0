// The PID law by what it must do: PD without Ki, a running sum with it, and no winding up at the limit.
#include "common/control/pid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/config/controller_toml.hpp"
#include "host/evaluate/control_law.hpp"

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

TEST(PidController, StopsIntegratingWhereSomethingAfterItLimits) {
  PidController pid({{100, 0, 50, false}, 1000}, kPeriod_s, 1e9, 12);
  for (int tick = 0; tick < 1000; ++tick) EXPECT_NEAR(pid.update(1, 0), 101, 1e-9);  // not held back itself
  EXPECT_EQ(pid.integral_m_s(), 0);
}

TEST(PidController, IsWhatASessionAndAGainFileSay) {
  const std::string text =
      "controller = { type = \"pid\", kp_V_per_m = 60, ki_V_per_m_s = 120, kd_V_s_per_m = 2 }\n";
  const auto document = parse_toml(text, "s.toml");
  ASSERT_TRUE(document);
  const auto read = controller_from_toml(TomlReader(*document, "s.toml"));
  ASSERT_TRUE(read) << read.error().message;
  const auto* pid = std::get_if<PidGains>(&*read);
  ASSERT_NE(pid, nullptr);
  EXPECT_EQ(pid->ki_V_per_m_s, 120);
  const auto again = parse_toml(controller_to_toml(*read), "again.toml");
  ASSERT_TRUE(again);
  const auto same = controller_from_toml(TomlReader(*again, "again.toml"));
  ASSERT_TRUE(same);
  EXPECT_EQ(std::get<PidGains>(*same).pd.kd_V_s_per_m, 2);
  const auto lacks = parse_toml("controller = { type = \"pid\", kp_V_per_m = 60 }\n", "lacks.toml");
  EXPECT_FALSE(controller_from_toml(TomlReader(*lacks, "lacks.toml")));
}

TEST(PidController, RunsARecordingThatWasMadeWithIt) {
  Recording recording;
  recording.controller = PidGains{{60, 2, 50, false}, 120};
  for (int k = 0; k < 200; ++k) recording.r_m.push_back(0.1);
  ControlLaw law(Rig{}, recording);
  PidController pid({{60, 2, 50, false}, 120}, Rig{}.period_s(), Rig{}.voltage_limit_V);
  for (std::size_t k = 0; k < 200; ++k) {
    const double y = 1e-4 * static_cast<double>(k);
    EXPECT_EQ(law.command_V(k, y), pid.update(0.1, y));
  }
}

}  // namespace
}  // namespace cartwright
