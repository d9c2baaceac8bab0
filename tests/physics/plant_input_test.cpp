// The chain from command to force: dead zone, saturation, gain asymmetry, current limit, lag, delay, heating.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using test::plant_at;
using test::run;
using test::speed_after;
using P = Parameter;

Model viscous() {
  return Model(2.0).set(P::viscous_coefficient, 5);
}

TEST(InputDeadZone, GivesNothingInsideAndIsShiftedOutside) {
  const Model model = viscous().set(P::dead_zone_half_width, 0.4);
  EXPECT_EQ(speed_after(model, 0.4, 5), 0.0);
  EXPECT_EQ(speed_after(model, -0.399, 5), 0.0);
  EXPECT_NEAR(speed_after(model, 1.4, 5), speed_after(viscous(), 1.0, 5), 1e-12);
  EXPECT_NEAR(speed_after(model, -1.4, 5), speed_after(viscous(), -1.0, 5), 1e-12);
}

TEST(VoltageSaturation, MakesLargerCommandsEqual) {
  const Model model = viscous().set(P::saturation_limit, 3);
  EXPECT_EQ(speed_after(model, 2.9, 1), speed_after(viscous(), 2.9, 1));
  EXPECT_EQ(speed_after(model, 12, 1), speed_after(viscous(), 3, 1));
  EXPECT_EQ(speed_after(model, -5, 1), speed_after(viscous(), -3, 1));
}

TEST(AmplifierGainAsymmetry, GainsDifferByTheRelativeDifferenceAboutTheirMean) {
  const double d = 0.3;
  const Model model = viscous().set(P::amplifier_gain_difference, d);
  const double up = speed_after(model, 1, 10), down = -speed_after(model, -1, 10),
               even = speed_after(viscous(), 1, 10);
  EXPECT_NEAR((up - down) / even, d, 1e-9);
  EXPECT_NEAR(0.5 * (up + down), even, 1e-12);
}

TEST(CurrentLimit, LimitsTheStartButNotTheTerminalSpeed) {
  const Model model = viscous().set(P::current_limit, 4);
  Plant plant = plant_at(model, 0);
  plant.advance(6, 1e-3);  // beta u = 12, three times the limit
  EXPECT_NEAR(plant.state().velocity_m_per_s, 4e-3, 1e-12);
  EXPECT_NEAR(speed_after(model, 6, 10), speed_after(viscous(), 6, 10), 1e-9);
  // Plugging: at speed a reversed voltage brakes with no more than the limit.
  Plant braking = plant_at(model, 0, 1.0);
  braking.advance(-6, 1e-3);
  EXPECT_NEAR(braking.state().velocity_m_per_s, 1.0 - 4e-3, 1e-12);
}

TEST(ArmatureLag, ReachesSixtyThreePerCentAfterOneTimeConstant) {
  const double tau = 0.02;
  const Model model = Model(2.0).set(P::armature_time_constant, tau);
  Plant plant = plant_at(model, 0);
  plant.advance(1.0, tau);
  EXPECT_NEAR(plant.state().armature_V, 1 - std::exp(-1), 1e-12);
  // In the long run the speed lags the immediate one by the area above the rise, beta u tau.
  EXPECT_NEAR(speed_after(model, 1.0, 1.0), 2.0 * (1.0 - tau), 1e-9);
}

TEST(ArmatureLag, TurnsThePhaseOfASineByItsArcTangent) {
  const double tau = 0.01, w = 2 * std::numbers::pi * 10;
  Plant plant = plant_at(Model(1.0).set(P::armature_time_constant, tau), 0);
  double sine = 0, cosine = 0;
  constexpr double kTick_s = 1e-4;
  for (int tick = 0; tick < 10000; ++tick) {
    plant.advance(std::sin(w * kTick_s * (tick + 0.5)), kTick_s);  // the hold's middle is the sine's
    if (tick < 5000) continue;
    sine += plant.state().armature_V * std::sin(w * kTick_s * (tick + 1));
    cosine += plant.state().armature_V * std::cos(w * kTick_s * (tick + 1));
  }
  EXPECT_NEAR(-std::atan2(cosine, sine), std::atan(w * tau), 1e-4);
  EXPECT_NEAR(std::hypot(sine, cosine) / 2500, 1 / std::hypot(1, w * tau), 1e-4);
}

TEST(ArmatureLag, VanishesWithItsTimeConstant) {
  const auto place = [](double tau) {
    Model model = viscous();
    if (tau > 0) model.set(P::armature_time_constant, tau);
    Plant plant = plant_at(model, 0);
    for (int i = 0; i < 20; ++i) run(plant, i % 2 == 0 ? 2 : -1, 0.1);
    return plant.state().position_m;
  };
  EXPECT_NEAR(place(1e-6), place(0), 1e-5);
  EXPECT_GT(std::abs(place(1e-2) - place(0)), 100 * std::abs(place(1e-6) - place(0)));
}

TEST(TransportDelay, ShiftsTheResponseInTimeAlsoByFractionsOfATick) {
  const auto command = [](int tick) { return 3 * std::sin(0.02 * tick) + (tick > 300 ? -2 : 0); };
  for (const double delay_s : {3e-3, 2.5e-3, 0.37e-3, 17.123e-3, 0.1}) {
    const Model model = viscous().set(P::coulomb_level, 0.3);
    Plant prompt = plant_at(model, 0), late = plant_at(Model(model).set(P::transport_delay, delay_s), 0);
    late.advance(command(0), delay_s < 1e-3 ? delay_s : 1e-3);
    EXPECT_EQ(late.state().position_m, 0.0);
    late.reset(0);
    // The prompt cart is read at t, the late one at t + delay: cut the late one's hold there.
    const int whole = static_cast<int>(delay_s / 1e-3 + 1e-9);
    const double rest_s = delay_s - whole * 1e-3;
    for (int tick = 0; tick < 1000 + whole; ++tick) {
      if (tick >= whole) {
        Plant at = late;
        at.advance(command(tick), rest_s > 1e-9 ? rest_s : 1e-12);
        ASSERT_NEAR(at.state().position_m, prompt.state().position_m, 1e-9) << delay_s << " tick " << tick;
        prompt.advance(command(tick - whole), 1e-3);
      }
      late.advance(command(tick), 1e-3);
    }
  }
}

TEST(TransportDelay, CarriesTheVoltageOfItsStartStateUntilTheFirstCommandArrives) {
  Plant plant(viscous().set(P::transport_delay, 0.05));
  PlantState state;
  state.armature_V = 1.5;
  plant.reset(state);
  plant.advance(-3, 0.05);
  Plant prompt = plant_at(viscous(), 0);
  prompt.advance(1.5, 0.05);
  EXPECT_NEAR(plant.state().velocity_m_per_s, prompt.state().velocity_m_per_s, 1e-12);
}

TEST(MotorHeating, TerminalSpeedDecaysByItsLoss) {
  const Model model = viscous().set(P::heating_gain_loss, 0.2).set(P::heating_time_constant, 30);
  const double cold = speed_after(viscous(), 2, 300);
  EXPECT_NEAR(speed_after(model, 2, 300) / cold, 0.8, 1e-4);
  EXPECT_NEAR(speed_after(model, 2, 5) / cold, 1 - 0.2 * (1 - std::exp(-(5 - 1 / 5.0) / 30)), 1e-4);
}

TEST(MotorHeating, CountsFromWhenTheMotorWasCold) {
  PlantOptions options;
  options.heating_start_s = 100;
  Plant plant(viscous().set(P::heating_gain_loss, 0.2).set(P::heating_time_constant, 30), options);
  plant.reset(0, 0, 100);
  run(plant, 2, 2);
  EXPECT_NEAR(plant.state().velocity_m_per_s,
              speed_after(viscous().set(P::heating_gain_loss, 0.2).set(P::heating_time_constant, 30), 2, 2),
              1e-9);
}

}  // namespace
}  // namespace cartwright
