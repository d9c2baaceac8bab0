#include "host/identify/force_units.hpp"

#include <gtest/gtest.h>

#include "host/identify/identify.hpp"
#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

const std::vector<Term> kTerms{Term::viscous_friction, Term::coulomb_friction, Term::constant_force};

Model pushed_cart() {
  return Model(1.9)
      .set(Parameter::viscous_coefficient, 5)
      .set(Parameter::coulomb_level, 0.5)
      .set(Parameter::constant_acceleration, 0.1);
}

const Session& session() {
  static const Session made = SimulatedSession(pushed_cart()).add_usual(2).get();
  return made;
}

Identification fitted(const ForceScale& scale) {
  IdentifyOptions options;
  options.force_scale = scale;
  const auto result = identify(session(), *TermSet::create(kTerms), options);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : Identification{};
}

double width(const Estimate& estimate) {
  return estimate.high - estimate.low;
}

TEST(ForceUnits, TheDriveGivesMassAndForces) {
  const Identification found = fitted({.drive_N_per_V = 38, .mass_kg = {}});  // a cart of 20 kg
  ASSERT_EQ(found.forces.size(), 4u);
  const double truths[] = {20, 100, 10, 2};
  const char* const names[] = {"moving_mass_kg", "viscous_friction.coefficient_N_s_per_m",
                               "coulomb_friction.level_N", "constant_force.force_N"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found.forces[i].name, names[i]);
    const Estimate& force = found.forces[i].estimate;
    EXPECT_NEAR(force.value, truths[i], 0.02 * truths[i]) << names[i];
    ASSERT_TRUE(force.has_interval()) << names[i];
    EXPECT_NEAR(force.value, truths[i], 1.5 * width(force)) << names[i];
  }
}

TEST(ForceUnits, AKnownMassScalesIntervalsAndNothingElse) {
  const Identification found = fitted({.drive_N_per_V = {}, .mass_kg = 20});
  ASSERT_EQ(found.forces.size(), 4u);
  EXPECT_EQ(found.forces[0].name, "drive_N_per_V");
  for (std::size_t i = 0; i < 4; ++i) {
    const Estimate& plain = found.estimates[i].estimate;
    const Estimate& force = found.forces[i].estimate;
    EXPECT_NEAR(force.value, 20 * plain.value, 1e-9 * std::abs(force.value));
    EXPECT_NEAR(width(force), 20 * width(plain), 1e-9 * width(force)) << found.forces[i].name;
  }
}

TEST(ForceUnits, WhatGainAndFrictionShareCountsOnce) {
  // Damping over gain: in c and in beta the same error of the voltage scale, which their ratio does not have.
  const Identification found = fitted({.drive_N_per_V = 38, .mass_kg = {}});
  const auto relative = [](const Estimate& e) { return 0.5 * (e.high - e.low) / std::abs(e.value); };
  const double apart =
      std::hypot(relative(found.estimates[0].estimate), relative(found.estimates[1].estimate));
  EXPECT_LT(relative(found.forces[1].estimate), apart);
}

TEST(ForceUnits, LengthsTimesAndSharesAreNoForces) {
  const ForceScale scale{.drive_N_per_V = 38, .mass_kg = {}};
  for (const Parameter parameter :
       {Parameter::stribeck_speed, Parameter::cogging_period, Parameter::cogging_phase,
        Parameter::exponential_alpha2, Parameter::armature_time_constant, Parameter::missed_rate,
        Parameter::asymmetric_viscous_difference, Parameter::dead_zone_half_width}) {
    EXPECT_EQ(force_name(parameter, scale), std::nullopt) << dotted_name(parameter);
  }
  EXPECT_EQ(force_name(Parameter::spring_stiffness, scale), "cable_spring.stiffness_N_per_m");
  EXPECT_EQ(force_name(Parameter::drag_coefficient, scale), "quadratic_drag.coefficient_N_s2_per_m2");
  EXPECT_EQ(force_name(Parameter::cogging_amplitude, scale), "cogging.amplitude_N");
}

TEST(ForceUnits, NothingIsAddedWithoutAScale) {
  EXPECT_TRUE(identify(session(), *TermSet::create(kTerms))->forces.empty());
}

}  // namespace
}  // namespace cartwright
