// Backlash and flexible coupling: two masses.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using test::plant_at;
using test::run;
using P = Parameter;

TEST(Backlash, LostMotionOfASlowReversalEqualsTheGap) {
  const double gap = 1e-3;
  Model model =
      Model(1.0).set(P::viscous_coefficient, 10).set(P::coulomb_level, 0.5).set(P::backlash_gap, gap);
  Plant plant = plant_at(model, 0);
  run(plant, 0.7, 1);  // creep against one flank
  EXPECT_EQ(plant.state().contact, 1);
  EXPECT_NEAR(plant.state().motor_position_m - plant.state().position_m, gap / 2, 1e-12);
  run(plant, 0, 1);
  const PlantState turn = plant.state();
  ASSERT_EQ(turn.velocity_m_per_s, 0.0);
  // The motor alone breaks away at its share of friction; the cart stays where it is until the gap is
  // crossed.
  while (plant.state().position_m == turn.position_m) plant.advance(-0.6, 1e-4);
  EXPECT_NEAR(turn.motor_position_m - plant.state().motor_position_m, gap, 2e-5);
  EXPECT_EQ(plant.state().contact, -1);
}

TEST(Backlash, ImpactConservesMomentumAndNeverGainsEnergy) {
  const double share = 0.3, gap = 2e-3, v0 = 0.5;
  Model model = Model(1.0).set(P::backlash_gap, gap).set(P::backlash_load_share, share);
  Plant plant(model);
  PlantState state;
  state.motor_velocity_m_per_s = v0;
  plant.reset(state);
  run(plant, 0, 0.1);
  EXPECT_EQ(plant.state().contact, 1);
  EXPECT_NEAR(plant.state().velocity_m_per_s, (1 - share) * v0, 1e-12);
  EXPECT_EQ(plant.state().velocity_m_per_s, plant.state().motor_velocity_m_per_s);
}

TEST(Backlash, TheMotorStaysWithinTheGapWhateverHappens) {
  const double gap = 5e-4;
  Model model =
      Model(1.9).set(P::viscous_coefficient, 4).set(P::coulomb_level, 0.6).set(P::backlash_gap, gap);
  Plant plant = plant_at(model, 0);
  for (int tick = 0; tick < 20000; ++tick) {
    const double u = 3 * std::sin(0.011 * tick) + 4 * std::sin(0.23 * tick) + (tick % 37 < 18 ? 2 : -2);
    plant.advance(u, 1e-3);
    const double stretch = plant.state().motor_position_m - plant.state().position_m;
    ASSERT_LE(std::abs(stretch), 0.5 * gap * (1 + 1e-9)) << tick;
  }
}

TEST(Backlash, WithoutReversalsIsOneMass) {
  const Model one = Model(1.9).set(P::viscous_coefficient, 4).set(P::coulomb_level, 0.6);
  Plant single = plant_at(one, 0, 0.1), geared(Model(one).set(P::backlash_gap, 5e-4));
  PlantState state;
  state.velocity_m_per_s = state.motor_velocity_m_per_s = 0.1;
  state.contact = 1;
  geared.reset(state);
  for (int tick = 0; tick < 2000; ++tick) {
    const double u = 3 + 2 * std::sin(0.01 * tick);
    single.advance(u, 1e-3);
    geared.advance(u, 1e-3);
    ASSERT_NEAR(single.state().position_m, geared.state().position_m, 1e-9);
  }
}

TEST(Backlash, ACartWithoutFrictionFliesOnWhenTheMotorBrakes) {
  Model model = Model(1.0).set(P::coulomb_level, 0.5).set(P::backlash_gap, 1.0);
  model.set(P::backlash_load_friction_share, 0);
  Plant plant(model);
  PlantState state;
  state.velocity_m_per_s = state.motor_velocity_m_per_s = 0.2;
  state.contact = 1;
  plant.reset(state);
  run(plant, 0, 1);
  EXPECT_NEAR(plant.state().velocity_m_per_s, 0.2, 1e-12);  // no force on it
  EXPECT_EQ(plant.state().motor_velocity_m_per_s, 0.0);     // stopped by its own friction
}

TEST(FlexibleCoupling, SwingsAtItsResonanceWithTheCentreOfMassAtRest) {
  const double hz = 25, share = 0.3;
  Model model = Model(1.0).set(P::coupling_resonance, hz).set(P::coupling_damping_ratio, 0);
  model.set(P::coupling_load_share, share);
  Plant plant(model);
  PlantState state;
  state.motor_position_m = 1e-3;
  plant.reset(state);
  for (int half = 1; half <= 20; ++half) {
    plant.advance(0, 0.5 / hz);
    const PlantState& s = plant.state();
    EXPECT_NEAR(s.motor_position_m - s.position_m, half % 2 == 0 ? 1e-3 : -1e-3, 1e-7);
    EXPECT_NEAR(share * s.position_m + (1 - share) * s.motor_position_m, (1 - share) * 1e-3, 1e-12);
  }
}

TEST(FlexibleCoupling, DampingRatioIsTheLogarithmicDecrement) {
  const double hz = 25, ratio = 0.05;
  Model model = Model(1.0).set(P::coupling_resonance, hz).set(P::coupling_damping_ratio, ratio);
  model.set(P::coupling_load_share, 0.5);
  Plant plant(model);
  PlantState state;
  state.motor_position_m = 1e-3;
  plant.reset(state);
  const double damped_s = 1 / (hz * std::sqrt(1 - ratio * ratio));
  plant.advance(0, 10 * damped_s);
  const double left = (plant.state().motor_position_m - plant.state().position_m) / 1e-3;
  EXPECT_NEAR(-std::log(left) / 10, 2 * std::numbers::pi * ratio / std::sqrt(1 - ratio * ratio), 1e-4);
}

TEST(FlexibleCoupling, BecomesRigidAsItsResonanceGrows) {
  const Model rigid = Model(1.9).set(P::viscous_coefficient, 4).set(P::coulomb_level, 0.3);
  const auto deviation = [&](double hz) {
    Model model = Model(rigid).set(P::coupling_resonance, hz).set(P::coupling_damping_ratio, 0.3);
    model.set(P::coupling_load_share, 0.4);
    Plant one = plant_at(rigid, 0), two = plant_at(model, 0);
    double worst = 0;
    for (int tick = 0; tick < 2000; ++tick) {
      const double u = 3 + 2 * std::sin(0.02 * tick);  // no reversal: nothing sticks
      one.advance(u, 1e-3);
      two.advance(u, 1e-3);
      worst = std::max(worst, std::abs(one.state().position_m - two.state().position_m));
    }
    return worst;
  };
  const double soft = deviation(10), middle = deviation(40), stiff = deviation(160);
  EXPECT_LT(middle, soft / 4);
  EXPECT_LT(stiff, middle / 4);
  EXPECT_LT(deviation(640), 1e-6);
}

TEST(FlexibleCoupling, EachMassSticksByItself) {
  // The motor is held by its friction while the load swings freely against it: the load's own frequency.
  const double hz = 20, share = 0.5;
  Model model = Model(1.0).set(P::coulomb_level, 5).set(P::coupling_resonance, hz);
  model.set(P::coupling_damping_ratio, 0)
      .set(P::coupling_load_share, share)
      .set(P::coupling_load_friction_share, 0);
  Plant plant(model);
  PlantState state;
  state.position_m = 1e-4;
  plant.reset(state);
  const double alone_hz = hz * std::sqrt(1 - share);
  plant.advance(0, 10 / alone_hz);
  EXPECT_NEAR(plant.state().position_m, 1e-4, 1e-8);
  EXPECT_EQ(plant.state().motor_position_m, 0.0);
}

TEST(FlexibleCoupling, WithAGapIsFreeInsideIt) {
  Model model = Model(1.0).set(P::coupling_resonance, 20).set(P::coupling_damping_ratio, 0.1);
  model.set(P::coupling_load_share, 0.5).set(P::backlash_gap, 1e-2);
  Plant plant(model);
  PlantState state;
  state.velocity_m_per_s = 0.1;
  plant.reset(state);
  run(plant, 0, 0.049);
  EXPECT_EQ(plant.state().velocity_m_per_s, 0.1);
  EXPECT_EQ(plant.state().motor_velocity_m_per_s, 0.0);
  run(plant, 0, 0.5);
  EXPECT_NEAR(0.5 * (plant.state().velocity_m_per_s + plant.state().motor_velocity_m_per_s), 0.05, 1e-12);
}

TEST(Backlash, TeethThatGiveMeetAsOftenAsTheyMustInOneLongHold) {
  // A motor that hits the cart: the teeth bounce some forty times, and in the end the cart is pushed half a
  // gap ahead.
  const Model model = Model(1.0)
                          .set(P::viscous_coefficient, 1)
                          .set(P::coulomb_level, 0.2)
                          .set(P::backlash_gap, 1e-3)
                          .set(P::backlash_contact_resonance, 200)
                          .set(P::backlash_contact_damping_ratio, 0.02);
  PlantState hit;
  hit.motor_velocity_m_per_s = 0.5;
  Plant once(model), often(model);
  once.reset(hit);
  often.reset(hit);
  once.advance(2, 3);
  for (int tick = 0; tick < 3000; ++tick) often.advance(2, 1e-3);
  EXPECT_NEAR(once.state().position_m, often.state().position_m, 1e-6);
  EXPECT_NEAR(once.state().motor_position_m - once.state().position_m, 0.5e-3, 1e-5);
}

/// Greatest distance between two runs of a cart that is driven to and fro for two seconds.
double greatest_distance(const Model& a, const PlantOptions& as, const Model& b, const PlantOptions& bs) {
  Plant one = plant_at(a, 0, 0, as), other = plant_at(b, 0, 0, bs);
  double greatest = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    const double command_V = (tick / 250) % 2 == 0 ? 4 : -4;
    one.advance(command_V, 1e-3);
    other.advance(command_V, 1e-3);
    greatest = std::max(greatest, std::abs(one.state().position_m - other.state().position_m));
  }
  return greatest;
}

constexpr double kQuarterOfACount_m = 5.7e-6;

/// What changes with place, time or speed, one kind of it at a time.
const std::pair<const char*, std::function<void(Model&)>> kBends[] = {
    {"places",
     [](Model& m) {
       m.set(P::spot_peak, 0.4).set(P::spot_centre, 0.05).set(P::spot_width, 0.01);
       m.set(P::cogging_amplitude, 0.3).set(P::cogging_period, 0.012);
       m.set(P::spring_stiffness, 4).set(P::spring_neutral, 0.02);
     }},
    {"lag", [](Model& m) { m.set(P::armature_time_constant, 4e-3); }},
    {"heating", [](Model& m) { m.set(P::heating_gain_loss, 0.1).set(P::heating_time_constant, 1); }},
    {"push",
     [](Model& m) {
       m.set(P::disturbance_start, 0.4).set(P::disturbance_duration, 0.3).set(P::disturbance_peak, 2);
     }},
    {"exponential damping",
     [](Model& m) {
       m.set(P::exponential_alpha1, 5).set(P::exponential_alpha2, 6).set(P::exponential_gamma, 1);
     }},
    {"Stribeck", [](Model& m) { m.set(P::stribeck_excess, 1).set(P::stribeck_speed, 0.1); }},
    {"drag", [](Model& m) { m.set(P::drag_coefficient, 2); }},
    {"direction", [](Model& m) { m.set(P::asymmetric_viscous_difference, 0.3); }},
    {"current limit", [](Model& m) { m.set(P::current_limit, 6); }},
};

TEST(TwoMasses, WhatBendsTakenByStepsKeepsWhatItDoes) {
  const Model bare = Model(2.0).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.5);
  Model geared = bare, sprung = bare;
  geared.set(P::backlash_gap, 5e-4)
      .set(P::backlash_contact_resonance, 100)
      .set(P::backlash_contact_damping_ratio, 0.3);
  sprung.set(P::coupling_resonance, 30).set(P::coupling_damping_ratio, 0.05).set(P::coupling_load_share, 0.6);
  PlantOptions by_steps, finely;
  by_steps.step_s = 1e-3;
  by_steps.stiff_step_factor = 3;
  by_steps.linear_by_steps = true;
  finely.step_s = 2e-5;
  for (const Model& without : {geared, sprung}) {
    for (const auto& [name, add] : kBends) {
      SCOPED_TRACE(name);
      Model with = without;
      add(with);
      const double effect = greatest_distance(with, finely, without, finely);
      EXPECT_GT(effect, 1e-3);
      EXPECT_LT(greatest_distance(with, by_steps, with, finely), std::max(1e-3 * effect, kQuarterOfACount_m));
    }
    EXPECT_EQ(greatest_distance(without, by_steps, without, by_steps), 0);
  }
}

}  // namespace
}  // namespace cartwright
