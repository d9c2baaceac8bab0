#include "host/identify/identify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;

Identification fitted(const Session& session, const std::vector<Term>& terms) {
  const auto set = TermSet::create(terms);
  EXPECT_TRUE(set) << set.error().message;
  const auto result = identify(session, *set);
  EXPECT_TRUE(result) << result.error().message;
  return result ? *result : Identification{};
}

const ParameterEstimate& of(const Identification& result, Parameter parameter) {
  for (const ParameterEstimate& found : result.estimates) {
    if (found.parameter == parameter) return found;
  }
  ADD_FAILURE() << dotted_name(parameter) << " was not fitted";
  return result.estimates.front();
}

void expect_recovered(const Identification& result, const Model& truth, double relative) {
  for (const ParameterEstimate& found : result.estimates) {
    const double value = truth[found.parameter];
    EXPECT_NEAR(found.estimate.value, value, relative * std::abs(value)) << dotted_name(found.parameter);
    ASSERT_TRUE(found.estimate.has_interval()) << dotted_name(found.parameter);
    // The tests know the truth to more digits than 95 %: three half widths.
    EXPECT_NEAR(found.estimate.value, value, 1.5 * (found.estimate.high - found.estimate.low))
        << dotted_name(found.parameter);
  }
}

TEST(Identify, FindsGainDampingAndFrictionThatSticks) {
  // The steps end stuck, 0.5 m/s^2 off the reference's pull: those rows must not be taken for friction.
  expect_recovered(
      fitted(SimulatedSession(cart()).add_usual(2).get(), {Term::viscous_friction, Term::coulomb_friction}),
      cart(), 5e-3);
}

struct Case {
  const char* name;
  Model truth;
  std::vector<Term> terms;
  double relative;
};

class IdentifyTerms : public testing::TestWithParam<Case> {};

TEST_P(IdentifyTerms, AreFoundWithTheRest) {
  const Case& known = GetParam();
  std::vector<Term> terms{Term::viscous_friction, Term::coulomb_friction};
  terms.insert(terms.end(), known.terms.begin(), known.terms.end());
  expect_recovered(fitted(SimulatedSession(known.truth).add_usual(2).get(), terms), known.truth,
                   known.relative);
}

INSTANTIATE_TEST_SUITE_P(
    Vocabulary, IdentifyTerms,
    testing::Values(
        Case{"constant_force",
             cart().set(Parameter::constant_acceleration, 0.2),
             {Term::constant_force},
             0.02},
        Case{"cable_spring",
             cart().set(Parameter::spring_stiffness, 6).set(Parameter::spring_neutral, 0.03),
             {Term::cable_spring},
             0.03},
        Case{"quadratic_drag", cart().set(Parameter::drag_coefficient, 3), {Term::quadratic_drag}, 0.03},
        Case{"asymmetric",
             cart().set(Parameter::asymmetric_viscous_difference, 0.2),
             {Term::asymmetric_viscous_friction},
             0.05},
        Case{"amplifier",
             cart().set(Parameter::amplifier_gain_difference, -0.2),
             {Term::amplifier_gain_asymmetry},
             0.02},
        Case{"delay", cart().set(Parameter::transport_delay, 4.3e-3), {Term::transport_delay}, 0.02},
        Case{"lag", cart().set(Parameter::armature_time_constant, 5e-3), {Term::armature_lag}, 0.03},
        Case{"dead_zone", cart().set(Parameter::dead_zone_half_width, 0.3), {Term::input_dead_zone}, 0.05},
        Case{"cogging",
             cart()
                 .set(Parameter::cogging_amplitude, 0.8)
                 .set(Parameter::cogging_period, 0.016)
                 .set(Parameter::cogging_phase, 1.0),
             {Term::cogging},
             0.03},
        Case{"spot",
             cart()
                 .set(Parameter::spot_peak, 0.8)
                 .set(Parameter::spot_centre, 0.05)
                 .set(Parameter::spot_width, 0.02),
             {Term::position_dependent_friction},
             0.05}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Identify, NeedsNoControllerAndNoReference) {
  SimulatedSession simulated{cart()};
  simulated.add_usual(2);
  for (Recording& recording : simulated.edit().recordings) {
    recording.controller = std::monostate{};
    recording.r_m.clear();
  }
  const Identification result = fitted(simulated.get(), {Term::viscous_friction, Term::coulomb_friction});
  EXPECT_EQ(result.twins, 0u);
  expect_recovered(result, cart(), 5e-3);
}

TEST(Identify, UsesTheTwinWhereTheControllerIsKnown) {
  EXPECT_EQ(
      fitted(SimulatedSession(cart()).add_usual(1).get(), {Term::viscous_friction, Term::coulomb_friction})
          .twins,
      2u);
}

TEST(Identify, WindowsDoNotCrossAGap) {
  // Between rows 700 and 900 the log is lost and the encoder re-zeroed.
  SimulatedSession simulated{cart()};
  simulated.add_usual(2);
  for (Recording& recording : simulated.edit().recordings) {
    recording.controller = std::monostate{};
    for (auto* column : {&recording.t_s, &recording.y_m, &recording.u_V, &recording.r_m}) {
      column->erase(column->begin() + 700, column->begin() + 900);
    }
    for (std::size_t row = 700; row < recording.size(); ++row) recording.y_m[row] += 0.2;
  }
  expect_recovered(fitted(simulated.get(), {Term::viscous_friction, Term::coulomb_friction}), cart(), 0.01);
}

TEST(Identify, WhatOnlyActsTogetherIsNotSeparated) {
  const Model truth = cart().set(Parameter::spring_stiffness, 6).set(Parameter::spring_neutral, 0.03);
  const Identification result =
      fitted(SimulatedSession(truth).add_usual(1).get(),
             {Term::viscous_friction, Term::coulomb_friction, Term::cable_spring, Term::constant_force});
  EXPECT_THAT(result.not_separable,
              testing::UnorderedElementsAre(Parameter::spring_neutral, Parameter::constant_acceleration));
  EXPECT_FALSE(of(result, Parameter::constant_acceleration).estimate.has_interval());
  // What the data does give is right: the push at y = 0.
  EXPECT_NEAR(result.model[Parameter::constant_acceleration], 6 * 0.03, 0.02);
}

TEST(Identify, NamesOneWaveOfTheCogging) {
  const Model truth = cart()
                          .set(Parameter::cogging_amplitude, 0.8)
                          .set(Parameter::cogging_period, 0.016)
                          .set(Parameter::cogging_phase, 1.0);
  std::vector<Parameter> names;
  for (const ParameterEstimate& found :
       fitted(SimulatedSession(truth).add_usual(1).get(), {Term::coulomb_friction, Term::cogging}).estimates)
    names.push_back(found.parameter);
  EXPECT_THAT(names, testing::ElementsAre(Parameter::voltage_gain, Parameter::coulomb_level,
                                          Parameter::cogging_amplitude, Parameter::cogging_period,
                                          Parameter::cogging_phase));
}

TEST(Identify, ALimitThatIsNeverReachedHasNoInterval) {
  const Identification result =
      fitted(SimulatedSession(cart()).add_usual(2).get(),
             {Term::viscous_friction, Term::coulomb_friction, Term::voltage_saturation});
  EXPECT_FALSE(of(result, Parameter::saturation_limit).estimate.has_interval());
  EXPECT_TRUE(of(result, Parameter::coulomb_level).estimate.has_interval());
}

TEST(Identify, WhatMayBeZeroHasNoShape) {
  // There is no spot on this rail, so it lies nowhere and has no width.
  const Identification result =
      fitted(SimulatedSession(cart()).add_usual(2).get(),
             {Term::viscous_friction, Term::coulomb_friction, Term::position_dependent_friction});
  const Estimate peak = of(result, Parameter::spot_peak).estimate;
  ASSERT_TRUE(peak.has_interval());
  EXPECT_LE(peak.low, 0);
  EXPECT_FALSE(of(result, Parameter::spot_centre).estimate.has_interval());
  EXPECT_FALSE(of(result, Parameter::spot_width).estimate.has_interval());
}

TEST(Identify, OneDirectionCannotTellFrictionFromAForce) {
  SimulatedSession simulated{cart()};
  simulated.rig().travel_m = {-10, 10};
  simulated.add("away.csv", {80, 2}, 3, [](double t_s) { return 0.3 * t_s + 0.02 * std::sin(6 * t_s); });
  // From 0.3 s on the cart only ever moves one way.
  Recording& recording = simulated.edit().recordings.front();
  recording.controller = std::monostate{};
  for (auto* column : {&recording.t_s, &recording.y_m, &recording.u_V, &recording.r_m}) {
    column->erase(column->begin(), column->begin() + 300);
  }
  const Identification result =
      fitted(simulated.get(), {Term::viscous_friction, Term::coulomb_friction, Term::constant_force});
  EXPECT_THAT(result.not_separable,
              testing::IsSupersetOf({Parameter::coulomb_level, Parameter::constant_acceleration}));
  EXPECT_TRUE(of(result, Parameter::voltage_gain).estimate.has_interval());
}

TEST(Identify, FrictionThatIsNotThereLiesAtItsBound) {
  // A spring that pushes away from the middle makes the best drag negative; it is held at zero and flagged.
  const Model truth = Model(1.9).set(Parameter::viscous_coefficient, 5);
  SimulatedSession simulated{truth};
  simulated.add_usual(1);
  for (Recording& recording : simulated.edit().recordings) {
    for (std::size_t row = 0; row < recording.size(); ++row) recording.u_V[row] *= 1.2;
    recording.controller = std::monostate{};
  }
  const Identification drag = fitted(simulated.get(), {Term::quadratic_drag});
  for (const ParameterEstimate& found : drag.estimates)
    EXPECT_GE(found.estimate.value, info(found.parameter).lower);
  const Identification none =
      fitted(SimulatedSession(Model(1.9).set(Parameter::viscous_coefficient, 5)).add_usual(1).get(),
             {Term::viscous_friction, Term::coulomb_friction});
  const ParameterEstimate& coulomb = of(none, Parameter::coulomb_level);
  EXPECT_LT(coulomb.estimate.value, 2e-3);
  EXPECT_GE(coulomb.estimate.low, 0);
}

TEST(Identify, SaysHowFarItsSearchForShapesIs) {
  const Session session = SimulatedSession(cart()).add_usual(1).get();
  IdentifyOptions options;
  std::vector<double> parts;
  options.progress = [&parts](double part) { parts.push_back(part); };
  ASSERT_TRUE(identify(session, *TermSet::create({Term::stribeck_friction}), options));
  ASSERT_GE(parts.size(), 20u);
  EXPECT_GT(parts.front(), 0);
  EXPECT_NEAR(parts.back(), 1, 1e-12);
}

TEST(Identify, SaysWhichTermsItCannotFit) {
  const auto set = TermSet::create({Term::backlash});
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message,
              HasSubstr("backlash cannot be fitted by the integral method; it fits viscous_friction"));
  const auto difference = TermSet::create({Term::asymmetric_viscous_friction});
  ASSERT_FALSE(difference);
  EXPECT_THAT(difference.error().message, HasSubstr("viscous_friction"));
}

TEST(Identify, ACartThatDoesNotMoveIsRefused) {
  SimulatedSession simulated{cart()};
  simulated.add("still.csv", {60, 0}, 2, [](double) { return 0.001; });
  const auto result = identify(simulated.get(), *TermSet::create({Term::viscous_friction}));
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("moves too little"));
}

}  // namespace
}  // namespace cartwright
