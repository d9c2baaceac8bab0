// Coulomb, Stribeck, position-dependent and presliding friction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using test::plant_at;
using test::run;
using P = Parameter;

/// Slowly raises the voltage; the drive acceleration at which the cart first moves.
double breakaway(const Model& model, double at_m) {
  Plant plant = plant_at(model, at_m);
  for (double u = 0; u < 5; u += 1e-4) {
    plant.advance(u, 1e-3);
    if (plant.state().velocity_m_per_s != 0) return u * model[P::voltage_gain];
  }
  return INFINITY;
}

TEST(CoulombFriction, CoastsToTheDistanceThatItsEnergyAllows) {
  for (const double step_s : {1e-4, 1e-3, 0.1}) {
    PlantOptions options;
    options.step_s = step_s;
    Plant plant = plant_at(Model(2.0).set(P::coulomb_level, 0.5), 0, 0.3, options);
    run(plant, 0, 1);
    EXPECT_NEAR(plant.state().position_m, 0.3 * 0.3 / (2 * 0.5), 1e-12);
    EXPECT_EQ(plant.state().velocity_m_per_s, 0.0);
  }
}

TEST(CoulombFriction, HoldsExactlyStillBelowItsLevelForAnyStep) {
  // A spring term of no effect at the start forces the numerical integrator beside the closed form.
  for (const double stiffness : {0.0, 1e-9}) {
    for (const double tick_s : {1e-5, 1e-3, 0.25, 10.0}) {
      Model model = Model(2.0).set(P::coulomb_level, 0.5);
      if (stiffness > 0) model.set(P::spring_stiffness, stiffness).set(P::spring_neutral, 0.1);
      Plant plant = plant_at(model, 0.1);
      for (int tick = 0; tick < 40; ++tick) {
        plant.advance(tick % 2 == 0 ? 0.2499 : -0.2499, tick_s);
        ASSERT_EQ(plant.state().position_m, 0.1);
        ASSERT_EQ(plant.state().velocity_m_per_s, 0.0);
      }
      plant.advance(0.2501, tick_s);
      EXPECT_GT(plant.state().velocity_m_per_s, 0.0);
    }
  }
}

TEST(CoulombFriction, StopsOnceAndNeverChatters) {
  Plant plant = plant_at(Model(2.0).set(P::coulomb_level, 0.5).set(P::drag_coefficient, 1), 0, 0.3);
  bool stopped = false;
  for (int tick = 0; tick < 2000; ++tick) {
    plant.advance(0.1, 1e-3);
    const double v = plant.state().velocity_m_per_s;
    if (stopped) {
      ASSERT_EQ(v, 0.0);
    }
    ASSERT_GE(v, 0.0);
    stopped = v == 0.0;
  }
  EXPECT_TRUE(stopped);
}

TEST(CoulombFriction, ReversesWithTwiceItsLevelBetweenTheTwoDirections) {
  // Under one drive the deceleration against it and the acceleration along it differ by twice the level.
  const double level = 0.5, drive = -3.0, v0 = 0.2;
  Plant plant = plant_at(Model(1.0).set(P::coulomb_level, level), 0, v0);
  const double stop_s = v0 / (-drive + level);
  plant.advance(drive, stop_s);
  EXPECT_NEAR(plant.state().velocity_m_per_s, 0, 1e-12);
  plant.advance(drive, 0.1);
  EXPECT_NEAR(plant.state().velocity_m_per_s, (drive + level) * 0.1, 1e-12);
}

TEST(CoulombFriction, ReleasesInsideAStepWhenTheDriveGrowsWithTheArmature) {
  // The push reaches the level at t = tau ln(u/(u - level)), whatever the step; then it moves at once.
  const Model model = Model(1.0).set(P::coulomb_level, 0.5).set(P::armature_time_constant, 0.1);
  const double release_s = 0.1 * std::log(1.0 / (1.0 - 0.5));
  Plant plant = plant_at(model, 0);
  plant.advance(1.0, release_s - 1e-7);
  EXPECT_EQ(plant.state().velocity_m_per_s, 0.0);
  plant.reset(0);
  plant.advance(1.0, release_s + 1e-5);
  EXPECT_GT(plant.state().velocity_m_per_s, 0.0);
}

TEST(StribeckFriction, BreaksAwayAboveRunningFriction) {
  const Model model =
      Model(2.0).set(P::coulomb_level, 0.4).set(P::stribeck_excess, 0.3).set(P::stribeck_speed, 0.02);
  EXPECT_NEAR(breakaway(model, 0), 0.7, 1e-3);
  // At twenty times its speed nothing of the excess is left: deceleration over 10 ms is the running level.
  Plant plant = plant_at(model, 0, 0.4);
  run(plant, 0, 0.01);
  EXPECT_NEAR(0.4 - plant.state().velocity_m_per_s, 0.4 * 0.01, 1e-9);
}

TEST(StribeckFriction, SticksAndSlipsOnASlowlyPulledSpringAndPlainFrictionDoesNot) {
  // A push that grows with time minus a spring: the standard stick-slip experiment. Between slips v is
  // exactly zero.
  const auto stops = [](double excess) {
    Model model =
        Model(1.0).set(P::coulomb_level, 0.3).set(P::spring_stiffness, 100).set(P::viscous_coefficient, 1);
    if (excess > 0) model.set(P::stribeck_excess, excess).set(P::stribeck_speed, 0.01);
    Plant plant = plant_at(model, 0);
    int count = 0;
    bool moving = false;
    for (int tick = 0; tick < 20000; ++tick) {
      plant.advance(100 * 2e-3 * 1e-3 * tick, 1e-3);  // the spring's far end travels at 2 mm/s
      const bool now = plant.state().velocity_m_per_s != 0;
      count += moving && !now;
      moving = now;
    }
    return count;
  };
  EXPECT_GE(stops(0.5), 3);
  EXPECT_LE(stops(0.0), 1);
}

TEST(PositionDependentFriction, HoldsAtItsCentreAndNotAway) {
  const Model model = Model(2.0)
                          .set(P::coulomb_level, 0.2)
                          .set(P::spot_peak, 0.5)
                          .set(P::spot_centre, 0.1)
                          .set(P::spot_width, 0.01);
  EXPECT_NEAR(breakaway(model, 0.1), 0.7, 1e-3);
  EXPECT_NEAR(breakaway(model, 0.3), 0.2, 1e-3);
  EXPECT_NEAR(breakaway(model, 0.1 - 0.02), breakaway(model, 0.1 + 0.02), 1e-3);
}

TEST(PositionDependentFriction, TakesTheWorkOfItsAreaFromACartThatCrosses) {
  const double peak = 0.5, width = 0.01, v0 = 0.5;
  const Model model = Model(2.0).set(P::spot_peak, peak).set(P::spot_centre, 0.1).set(P::spot_width, width);
  Plant plant = plant_at(model, 0, v0);
  run(plant, 0, 0.6);
  const double v1 = plant.state().velocity_m_per_s;
  EXPECT_NEAR(0.5 * (v0 * v0 - v1 * v1), peak * width * std::sqrt(2 * std::numbers::pi), 1e-8);
}

/// A unit mass on a bristle.
Model bristle(double level_m_per_s2, double stiffness_per_s2) {
  return Model(1.0).set(P::coulomb_level, level_m_per_s2).set(P::presliding_stiffness, stiffness_per_s2);
}

/// How far it comes in a second when it is let go at a speed.
double coasted_m(const Model& model, double velocity_m_per_s) {
  Plant coasting = plant_at(model, 0, velocity_m_per_s);
  double farthest = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    coasting.advance(0, 1e-3);
    farthest = std::max(farthest, coasting.state().position_m);
  }
  return farthest;
}

TEST(PreslidingFriction, DeflectsLikeASpringAndReturns) {
  const double stiffness = 4e4;
  const Model model = bristle(0.5, stiffness).set(P::viscous_coefficient, 50);
  Plant plant = plant_at(model, 0.1);
  for (const double push : {0.2, 0.3, 0.1, -0.1, -0.2}) {
    run(plant, push, 1.0);
    EXPECT_NEAR(plant.state().position_m, 0.1 + push / stiffness, 1e-9);
  }
  run(plant, 0, 1.0);
  EXPECT_NEAR(plant.state().position_m, 0.1, 1e-9);
}

TEST(PreslidingFriction, StoresAndGivesBackEnergyBelowBreakaway) {
  // Without damping a nudged cart swings for ever at sqrt(k) about its start.
  const double stiffness = 4e4, nudge = 1e-3;
  const Model model = bristle(0.5, stiffness);
  Plant plant = plant_at(model, 0, nudge);
  double greatest = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    plant.advance(0, 1e-3);
    const PlantState& s = plant.state();
    const double energy =
        0.5 * s.velocity_m_per_s * s.velocity_m_per_s + 0.5 * stiffness * s.position_m * s.position_m;
    ASSERT_NEAR(energy, 0.5 * nudge * nudge, 0.01 * 0.5 * nudge * nudge);
    greatest = std::max(greatest, std::abs(s.position_m));
  }
  EXPECT_NEAR(greatest, nudge / std::sqrt(stiffness), 0.01 * nudge / std::sqrt(stiffness));
}

TEST(PreslidingFriction, BreaksAwayAtTheCoulombLevelAndThenCoastsLikeIt) {
  const double level = 0.5, stiffness = 4e4;
  const Model model = bristle(level, stiffness).set(P::viscous_coefficient, 50);
  Plant plant = plant_at(model, 0);
  double u = 0;
  while (u < 0.49) plant.advance(u += 1e-4, 1e-3);
  EXPECT_LT(plant.state().position_m, level / stiffness);
  run(plant, 0.55, 2.0);
  EXPECT_NEAR(plant.state().velocity_m_per_s, (0.55 - level) / 50, 1e-6);

  const double farthest = coasted_m(bristle(level, stiffness), 0.3);
  // Kinetic energy goes into sliding, and into the bristle first: level^2/(2 k) of it.
  EXPECT_NEAR(farthest, 0.3 * 0.3 / (2 * level) + 0.5 * level / stiffness, 1e-7);
}

Model dahl(double level_m_per_s2, double stiffness_per_s2) {
  return bristle(level_m_per_s2, stiffness_per_s2).set(P::presliding_dahl_exponent, 1);
}

TEST(DahlFriction, GivesMoreAndMoreAndIsTwiceAsStiffOnTheWayBack) {
  const double level = 0.5, stiffness = 4e4;
  Plant plant = plant_at(dahl(level, stiffness).set(P::viscous_coefficient, 2000), 0.1);
  // So much damping that it never swings: pushed from rest, F = level (1 - exp(-k x/level)).
  double there = 0;
  for (const double push : {0.1, 0.2, 0.3}) {
    run(plant, push, 1.0);
    there = 0.1 - level / stiffness * std::log(1 - push / level);
    EXPECT_NEAR(plant.state().position_m, there, 1e-8);
  }
  run(plant, 0, 1.0);
  EXPECT_NEAR(plant.state().position_m, there - level / stiffness * std::log(1 + 0.3 / level), 1e-8);
}

TEST(DahlFriction, SlidesLikeCoulombFriction) {
  const double level = 0.5, stiffness = 4e4;
  Plant plant = plant_at(dahl(level, stiffness).set(P::viscous_coefficient, 50), 0);
  run(plant, 0.55, 2.0);
  EXPECT_NEAR(plant.state().velocity_m_per_s, (0.55 - level) / 50, 1e-6);

  const double farthest = coasted_m(dahl(level, stiffness), 0.3);
  // On the way to its level it takes level^2/k less than that all along.
  EXPECT_NEAR(farthest, 0.3 * 0.3 / (2 * level) + level / stiffness, 1e-7);
}

TEST(DahlFriction, SwingsOutWithItsDampingRatio) {
  const double stiffness = 4e4, ratio = 0.1, nudge = 1e-6;  // far below its level
  const double w = std::sqrt(stiffness), swing = w * std::sqrt(1 - ratio * ratio);
  Plant plant = plant_at(dahl(0.5, stiffness).set(P::presliding_damping_ratio, ratio), 0, nudge);
  for (int tick = 1; tick <= 50; ++tick) {
    plant.advance(0, 1e-3);
    const double t = 1e-3 * tick;
    ASSERT_NEAR(plant.state().position_m, nudge / swing * std::exp(-ratio * w * t) * std::sin(swing * t),
                1e-3 * nudge / swing);
  }
}

/// The LuGre model in many small steps.
double lugre_position_m(double level, double stiffness, double damping, double damping_speed,
                        const std::vector<double>& pushes, double each_s) {
  constexpr double kStep_s = 1e-7;
  double y = 0, v = 0, z = 0;
  for (const double push : pushes) {
    for (double t = 0; t < each_s; t += kStep_s) {
      const double stretches = v - stiffness * std::abs(v) / level * z;
      const double fading = damping * std::exp(-std::pow(v / damping_speed, 2));
      v += kStep_s * (push - stiffness * z - fading * stretches);
      z += kStep_s * stretches;
      y += kStep_s * v;
    }
  }
  return y;
}

TEST(DahlFriction, WithDampingIsTheLuGreModel) {
  const double level = 0.5, stiffness = 1e4;
  const std::vector<double> pushes{0.4, 0.8, -0.6, 0.1, -0.3, 2.0, -2.0};
  for (const double ratio : {0.05, 0.5, 1.0}) {
    Plant plant = plant_at(dahl(level, stiffness).set(P::presliding_damping_ratio, ratio), 0);
    for (const double push : pushes) run(plant, push, 0.05);
    const double damping = 2 * ratio * std::sqrt(stiffness);
    EXPECT_NEAR(plant.state().position_m, lugre_position_m(level, stiffness, damping, INFINITY, pushes, 0.05),
                0.01 * level / stiffness)
        << "damping ratio " << ratio;
  }
}

TEST(DahlFriction, ItsDampingMayFadeWithTheSpeed) {
  const double level = 0.5, stiffness = 1e4, ratio = 0.5, speed = 3e-3;
  const std::vector<double> pushes{0.4, 0.8, -0.6, 0.1, -0.3};
  Plant plant = plant_at(
      dahl(level, stiffness).set(P::presliding_damping_ratio, ratio).set(P::presliding_damping_speed, speed),
      0);
  for (const double push : pushes) run(plant, push, 0.05);
  const double damping = 2 * ratio * std::sqrt(stiffness);
  const double fading_m = lugre_position_m(level, stiffness, damping, speed, pushes, 0.05);
  const double lasting_m = lugre_position_m(level, stiffness, damping, INFINITY, pushes, 0.05);
  EXPECT_NEAR(plant.state().position_m, fading_m, 0.01 * level / stiffness);
  EXPECT_GT(std::abs(fading_m - lasting_m), 0.1 * level / stiffness);
}

TEST(DahlFriction, WithASmallExponentIsElasticUpToBreakaway) {
  const double level = 0.5, stiffness = 4e4;
  const Model sharp = bristle(level, stiffness).set(P::viscous_coefficient, 50);
  Plant elastic = plant_at(sharp, 0),
        nearly = plant_at(Model(sharp).set(P::presliding_dahl_exponent, 1e-3), 0);
  for (const double push : {0.4, -0.3, 0.2}) {
    run(elastic, push, 0.5);
    run(nearly, push, 0.5);
    EXPECT_NEAR(nearly.state().position_m, elastic.state().position_m, 0.01 * level / stiffness);
  }
}

}  // namespace
}  // namespace cartwright
