// Viscous friction, its asymmetry, exponential damping, quadratic drag.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/plant_runs.hpp"

namespace cartwright {
namespace {

using test::plant_at;
using test::run;
using test::speed_after;
using P = Parameter;

TEST(ViscousFriction, CoastsItsSpeedOverItsCoefficientInAll) {
  Plant plant = plant_at(Model(2.0).set(P::viscous_coefficient, 5), 0, 0.4);
  run(plant, 0, 10);
  EXPECT_NEAR(plant.state().position_m, 0.4 / 5, 1e-9);
  EXPECT_GE(plant.state().velocity_m_per_s, 0);
}

TEST(ViscousFriction, TheClosedFormEqualsTheNumericalIntegration) {
  // A spring of no consequence switches the closed form off.
  const Model closed = Model(1.9).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.5);
  const Model integrated = Model(closed).set(P::spring_stiffness, 1e-12);
  Plant a = plant_at(closed, 0), b = plant_at(integrated, 0);
  for (int tick = 0; tick < 10000; ++tick) {
    const double u = 4 * std::sin(0.013 * tick);
    a.advance(u, 1e-3);
    b.advance(u, 1e-3);
    ASSERT_NEAR(a.state().position_m, b.state().position_m, 1e-9);
  }
}

TEST(ViscousFriction, TheClosedFormDoesNotDependOnHowTheHoldIsCut) {
  for (const double coefficient : {0.0, 1e-6, 5.0, 200.0}) {
    const Model model = Model(1.9).set(P::viscous_coefficient, coefficient).set(P::coulomb_level, 0.5);
    Plant whole = plant_at(model, 0, 0.3), cut = plant_at(model, 0, 0.3);
    for (const double u : {2.0, -3.0, 0.1}) {
      whole.advance(u, 0.5);
      for (int part = 0; part < 500; ++part) cut.advance(u, 1e-3);
      ASSERT_NEAR(whole.state().position_m, cut.state().position_m, 1e-11) << coefficient;
      ASSERT_NEAR(whole.state().velocity_m_per_s, cut.state().velocity_m_per_s, 1e-11) << coefficient;
    }
  }
}

TEST(AsymmetricViscousFriction, TerminalSpeedsDifferInTheRatioOfTheCoefficients) {
  const double d = 0.4;
  const Model model = Model(2.0).set(P::viscous_coefficient, 5).set(P::asymmetric_viscous_difference, d);
  const double forward = speed_after(model, 3, 10), backward = speed_after(model, -3, 10);
  EXPECT_NEAR(-backward / forward, (1 + d / 2) / (1 - d / 2), 1e-9);
  EXPECT_NEAR(0.5 * (1 / forward - 1 / backward), 5 / (2.0 * 3),
              1e-9);  // the mean coefficient is the symmetric one
}

TEST(ExponentialDamping, GoesFromAlphaPlusGammaAtRestToGammaAtSpeed) {
  const Model model =
      Model(1.0).set(P::exponential_alpha1, 6).set(P::exponential_alpha2, 40).set(P::exponential_gamma, 2);
  // Creeping under a tiny push, and running under a large one.
  EXPECT_NEAR(1e-6 / speed_after(model, 1e-6, 10), 8, 1e-3);
  EXPECT_NEAR(2.0 / speed_after(model, 2.0, 20), 2, 1e-6);
}

TEST(ExponentialDamping, WithoutDecayIsViscousFriction) {
  const Model exponential =
      Model(1.0).set(P::exponential_alpha1, 6).set(P::exponential_alpha2, 0).set(P::exponential_gamma, 2);
  Plant plant = plant_at(exponential, 0, 0.4);
  run(plant, 0, 10);
  EXPECT_NEAR(plant.state().position_m, 0.4 / 8, 1e-9);
}

TEST(QuadraticDrag, TheSpeedFallsByTheSameFactorOverEveryMetre) {
  const double drag = 4;
  for (const double direction : {1.0, -1.0}) {
    Plant plant = plant_at(Model(1.0).set(P::drag_coefficient, drag), 0, direction * 0.8);
    for (int second = 0; second < 5; ++second) {
      const PlantState before = plant.state();
      run(plant, 0, 1);
      const PlantState after = plant.state();
      EXPECT_NEAR(std::log(before.velocity_m_per_s / after.velocity_m_per_s),
                  drag * std::abs(after.position_m - before.position_m), 1e-9);
    }
  }
}

TEST(QuadraticDrag, TerminalSpeedGrowsWithTheRootOfTheDrive) {
  const Model model = Model(1.0).set(P::drag_coefficient, 4);
  EXPECT_NEAR(speed_after(model, 4, 20) / speed_after(model, 1, 20), 2, 1e-9);
}

}  // namespace
}  // namespace cartwright
