// The control laws, by what they must do: static gain, filter, limits, memory, hysteresis.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/control/dual_relay.hpp"
#include "common/control/pd.hpp"

namespace cartwright {
namespace {

constexpr double kPeriod_s = 1e-3;

TEST(PdController, AtRestGivesItsProportionalGainAndHoldsTheLimit) {
  PdController pd({60, 5, 50, false}, kPeriod_s, 12);
  EXPECT_DOUBLE_EQ(pd.update(0.1, 0), 6);
  EXPECT_DOUBLE_EQ(pd.update(0.1, 0), 6);  // a constant error has no derivative
  EXPECT_EQ(pd.update(10, 0), 12);
  EXPECT_EQ(pd.update(-10, 0), -12);
}

TEST(PdController, TheFirstTickDoesNotKickAndAResetIsAFirstTick) {
  PdController pd({0, 5, 50, false}, kPeriod_s, 12);
  EXPECT_EQ(pd.update(0.3, 0), 0);
  EXPECT_NE(pd.update(0.4, 0), 0);
  pd.reset();
  EXPECT_EQ(pd.update(-0.2, 0), 0);
}

TEST(PdController, ARampHasItsSlopeAsDerivativeAfterTheFilterSettles) {
  PdController pd({0, 2, 20, false}, kPeriod_s, 100);
  double u = 0;
  const int settle = static_cast<int>(1 / (2 * std::numbers::pi * 20) / kPeriod_s);
  for (int tick = 0; tick <= settle; ++tick) u = pd.update(0.5 * kPeriod_s * tick, 0);
  EXPECT_NEAR(u / (2 * 0.5), 1 - std::exp(-1), 0.05);  // one time constant
  for (int tick = settle + 1; tick < 1000; ++tick) u = pd.update(0.5 * kPeriod_s * tick, 0);
  EXPECT_NEAR(u, 2 * 0.5, 1e-9);
}

TEST(PdController, TheFilterDoesNotDependOnTheSampleRateInTheLongRun) {
  // exp(-2 pi f Ts) steps: halving the period and doubling the ticks leaves the filter's response to a ramp.
  const auto derivative = [](double period_s) {
    PdController pd({0, 1, 10, false}, period_s, 100);
    double u = 0;
    for (int tick = 0; tick * period_s < 0.03 - 1e-9; ++tick) u = pd.update(tick * period_s, 0);
    return u;
  };
  EXPECT_NEAR(derivative(1e-4), derivative(5e-5), 2e-3);
}

TEST(PdController, DerivativeOnTheMeasurementIgnoresTheReferenceAndDampsAlike) {
  PdController error({0, 5, 50, false}, kPeriod_s, 12), measurement({0, 5, 50, true}, kPeriod_s, 12);
  error.update(0, 0);
  measurement.update(0, 0);
  EXPECT_GT(error.update(0.1, 0), 0);
  EXPECT_EQ(measurement.update(0.1, 0), 0);
  error.reset();
  measurement.reset();
  for (int tick = 0; tick < 50; ++tick) {
    EXPECT_EQ(error.update(0, 1e-4 * tick), measurement.update(0, 1e-4 * tick));
  }
}

TEST(PdController, AnAddedVoltageComesBeforeTheLimit) {
  PdController pd({60, 0, 50, false}, kPeriod_s, 12);
  EXPECT_DOUBLE_EQ(pd.update(0.1, 0, -2), 4);
  EXPECT_EQ(pd.update(0.19, 0, 5), 12);
}

TEST(DualRelay, SignOfZeroIsPlus) {
  DualRelayController relay({2, 1.5, 0}, kPeriod_s, 12);
  EXPECT_DOUBLE_EQ(relay.update(0, 0), 3.5);
}

TEST(DualRelay, TheSecondRelayFollowsTheIntegralIncludingThisTick) {
  DualRelayController relay({2, 1.5, 0}, kPeriod_s, 12);
  EXPECT_DOUBLE_EQ(relay.update(0, 1), -3.5);    // integral -1 already counts
  EXPECT_DOUBLE_EQ(relay.update(0, -0.5), 0.5);  // error up, integral still -0.5
  EXPECT_DOUBLE_EQ(relay.update(0, -0.5), 3.5);  // integral back at zero
  relay.reset();
  EXPECT_DOUBLE_EQ(relay.update(0, -0.1), 3.5);
}

TEST(DualRelay, HysteresisKeepsTheFirstRelayUntilTheErrorHasPassedZeroByIt) {
  DualRelayController relay({2, 0, 1e-3}, kPeriod_s, 12);
  EXPECT_EQ(relay.update(0, -0.01), 2);
  EXPECT_EQ(relay.update(0, 0.9e-3), 2);  // passed zero, not yet by the hysteresis
  EXPECT_EQ(relay.update(0, 1.1e-3), -2);
  EXPECT_EQ(relay.update(0, -0.9e-3), -2);  // and back again
  EXPECT_EQ(relay.update(0, -1.1e-3), 2);
}

TEST(DualRelay, HoldsTheLimit) {
  DualRelayController relay({9, 8, 0}, kPeriod_s, 12);
  EXPECT_EQ(relay.update(0, -1), 12);
  EXPECT_EQ(relay.update(0, -1, -6), 11);
}

}  // namespace
}  // namespace cartwright
