// Constant force, cogging, cable spring, external disturbance.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using test::plant_at;
using test::run;
using test::speed_after;
using P = Parameter;

TEST(ConstantForce, GivesATerminalSpeedAndIsBalancedByItsVoltage) {
  const Model model = Model(2.0).set(P::viscous_coefficient, 5).set(P::constant_acceleration, 0.6);
  EXPECT_NEAR(speed_after(model, 0, 10), 0.6 / 5, 1e-9);
  EXPECT_EQ(speed_after(model, -0.3, 10), 0.0);
}

TEST(ConstantForce, MakesBreakawayUnequal) {
  const Model model = Model(1.0).set(P::coulomb_level, 0.5).set(P::constant_acceleration, 0.2);
  EXPECT_EQ(speed_after(model, 0.299, 1), 0.0);
  EXPECT_GT(speed_after(model, 0.301, 1), 0.0);
  EXPECT_EQ(speed_after(model, -0.699, 1), 0.0);
  EXPECT_LT(speed_after(model, -0.701, 1), 0.0);
}

TEST(Cogging, DoesNoWorkOverAPeriod) {
  const double period = 0.02;
  const Model model =
      Model(1.0).set(P::cogging_amplitude, 2).set(P::cogging_period, period).set(P::cogging_phase, 0.7);
  Plant plant = plant_at(model, 0, 0.5);
  std::vector<double> y, v;
  for (int tick = 0; tick < 4000; ++tick) {
    plant.advance(0, 1e-4);
    y.push_back(plant.state().position_m);
    v.push_back(plant.state().velocity_m_per_s);
  }
  // Speed against position repeats with the period: interpolate one period back.
  int compared = 0;
  for (std::size_t i = 1, back = 0; i < y.size(); ++i) {
    const double target = y[i] - period;
    if (target < y[0]) continue;
    while (y[back + 1] < target) ++back;
    const double w = (target - y[back]) / (y[back + 1] - y[back]);
    ASSERT_NEAR(v[i], (1 - w) * v[back] + w * v[back + 1], 1e-5);
    ++compared;
  }
  EXPECT_GT(compared, 3000);
}

TEST(Cogging, RestsOnlyWhereItsPushFallsThroughZero) {
  const double period = 0.02, phase = 0.7;
  const Model model = Model(1.0)
                          .set(P::viscous_coefficient, 20)
                          .set(P::cogging_amplitude, 2)
                          .set(P::cogging_period, period)
                          .set(P::cogging_phase, phase);
  for (double start = -0.03; start < 0.03; start += 0.0037) {
    Plant plant = plant_at(model, start);
    run(plant, 0, 5);
    const double turns =
        (2 * std::numbers::pi * plant.state().position_m / period + phase - std::numbers::pi) /
        (2 * std::numbers::pi);
    EXPECT_NEAR(turns, std::round(turns), 1e-5) << start;
    EXPECT_LE(std::abs(plant.state().position_m - start), 0.5 * period);
  }
}

TEST(Cogging, IsTheSumOfItsWaves) {
  const Model first =
      Model(1.0).set(P::cogging_amplitude, 2).set(P::cogging_period, 0.02).set(P::cogging_phase, 0.7);
  const Model second =
      Model(1.0).set(P::cogging_amplitude, 1.2).set(P::cogging_period, 0.007).set(P::cogging_phase, 2);
  const Model third =
      Model(1.0).set(P::cogging_amplitude, 0.5).set(P::cogging_period, 0.003).set(P::cogging_phase, -1);
  Model all = first;
  all.set(P::cogging_second_amplitude, 1.2)
      .set(P::cogging_second_period, 0.007)
      .set(P::cogging_second_phase, 2);
  all.set(P::cogging_third_amplitude, 0.5)
      .set(P::cogging_third_period, 0.003)
      .set(P::cogging_third_phase, -1);
  const double short_s = 1e-5;  // so that the push is still that of the start
  const auto push_at = [&](const Model& model, double y) {
    Plant plant = plant_at(model, y);
    plant.advance(0, short_s);
    return plant.state().velocity_m_per_s / short_s;
  };
  for (double y = -0.02; y < 0.02; y += 0.0013)
    EXPECT_NEAR(push_at(all, y), push_at(first, y) + push_at(second, y) + push_at(third, y), 1e-5) << y;
}

TEST(CableSpring, SwingsAboutItsNeutralPointWithPeriodTwoPiOverRootK) {
  const double stiffness = 30, neutral = 0.05, period_s = 2 * std::numbers::pi / std::sqrt(stiffness);
  Plant plant =
      plant_at(Model(1.0).set(P::spring_stiffness, stiffness).set(P::spring_neutral, neutral), 0.15);
  for (int half = 1; half <= 6; ++half) {
    plant.advance(0, 0.5 * period_s);
    EXPECT_NEAR(plant.state().position_m, neutral + (half % 2 == 0 ? 0.1 : -0.1), 1e-7);
    EXPECT_NEAR(plant.state().velocity_m_per_s, 0, 1e-6);
  }
}

TEST(CableSpring, BalancesADriveAtItsStaticDeflection) {
  const Model model =
      Model(2.0).set(P::spring_stiffness, 30).set(P::spring_neutral, 0.05).set(P::viscous_coefficient, 8);
  Plant plant = plant_at(model, 0);
  run(plant, 0.9, 10);
  EXPECT_NEAR(plant.state().position_m, 0.05 + 2.0 * 0.9 / 30, 1e-9);
}

TEST(ExternalDisturbance, GivesItsImpulseOnceAndOnlyInItsRecording) {
  const double peak = 3, duration_s = 0.0503;
  Model model = Model(1.0).set(P::disturbance_start, 0.20017).set(P::disturbance_duration, duration_s);
  model.set(P::disturbance_peak, peak);
  Plant pushed = plant_at(model, 0);
  run(pushed, 0, 0.2);
  EXPECT_EQ(pushed.state().velocity_m_per_s, 0.0);
  run(pushed, 0, 0.1);
  const double impulse = peak * duration_s / 2;  // of a squared half sine
  EXPECT_NEAR(pushed.state().velocity_m_per_s, impulse, 1e-9);
  run(pushed, 0, 1);
  EXPECT_NEAR(pushed.state().velocity_m_per_s, impulse, 1e-9);

  PlantOptions elsewhere;
  elsewhere.disturbance_active = false;
  Plant still = plant_at(model, 0, 0, elsewhere);
  run(still, 0, 1);
  EXPECT_EQ(still.state().position_m, 0.0);
}

TEST(ExternalDisturbance, StartsAStuckCartWhenItExceedsTheLevel) {
  const auto moved = [](double peak) {
    Model model = Model(1.0).set(P::coulomb_level, 0.5).set(P::disturbance_start, 0.1);
    model.set(P::disturbance_duration, 0.1).set(P::disturbance_peak, peak);
    Plant plant = plant_at(model, 0);
    run(plant, 0, 1);
    return plant.state().position_m;
  };
  EXPECT_EQ(moved(0.49), 0.0);
  EXPECT_GT(moved(0.6), 0.0);
  EXPECT_LT(moved(-0.6), 0.0);
}

}  // namespace
}  // namespace cartwright
