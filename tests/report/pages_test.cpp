#include <gmock/gmock.h>

#include "host/evaluate/closed_loop.hpp"
#include "host/report/pages/damping.hpp"
#include "host/report/pages/friction_curve.hpp"
#include "host/report/pages/gain_pairs.hpp"
#include "host/report/pages/identification_page.hpp"
#include "host/report/pages/parameters.hpp"
#include "host/report/pages/summary.hpp"
#include "host/report/unit.hpp"

namespace cartwright::report {
namespace {

Model cart_with_exponential_damping() {
  Model model(1.9165);
  model.set(Parameter::exponential_alpha1, 17.3264).set(Parameter::exponential_alpha2, 13.1068);
  return model.set(Parameter::exponential_gamma, 5.9986);
}

Model cart_with_viscous_friction() {
  return Model(1.8545).set(Parameter::viscous_coefficient, 6.152);
}

Recording step(const Model& cart, const Rig& rig, std::string file, double kp, double kd) {
  Recording recording;
  recording.file = std::move(file);
  recording.experiment = "step";
  recording.controller = PdGains{kp, kd, 50};
  for (int k = 0; k < 1500; ++k) {
    recording.t_s.push_back(k * rig.period_s());
    recording.r_m.push_back(k < 200 ? 0 : 0.1);
  }
  recording.y_m = recording.u_V = std::vector<double>(recording.t_s.size(), 0.0);
  return simulate(cart, rig, recording);
}

Session two_pairs_and_a_repeat() {
  Session session;
  session.rig.encoder_resolution_m = 2.275e-5;
  const Model cart = cart_with_exponential_damping();
  session.recordings = {step(cart, session.rig, "b.csv", 80, 5), step(cart, session.rig, "a.csv", 60, 0),
                        step(cart, session.rig, "repeat.csv", 60, 0)};
  return session;
}

TEST(GainPairs, TheTrueModelIsWithinACountAndAWrongOneIsNot) {
  const auto errors = gain_pair_errors(two_pairs_and_a_repeat(), {{"true", cart_with_exponential_damping()},
                                                                  {"linear", cart_with_viscous_friction()}});
  ASSERT_EQ(errors.size(), 2u) << "one per pair, not one per recording";
  EXPECT_EQ(errors[0].file, "a.csv") << "in order of the gains";
  for (const GainPairError& one : errors) {
    EXPECT_LT(one.over_1_s_m[0], 2.275e-5);
    EXPECT_GT(one.over_1_s_m[1], 3e-4);
    EXPECT_GT(one.over_half_s_m[1], 3e-4);
  }
}

TEST(FrictionCurve, IsOddWithoutAPushAndHoldsTheLevelsOnEitherSide) {
  const Model cart = Model(2).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
  const Plot plot = friction_curves({{"cart", cart}}, 2);
  const Series& curve = plot.series.front();
  const std::size_t last = curve.y.size() - 1;
  EXPECT_NEAR(curve.y[last], 10.5, 1e-12);
  for (std::size_t i = 0; i < last / 2; ++i) EXPECT_NEAR(curve.y[i], -curve.y[last - i], 1e-12);
  EXPECT_TRUE(std::isnan(curve.y[last / 2])) << "at rest friction is anything up to its level";
}

TEST(StepDamping, IsTakenFromTheErrorWhereTheCommandIsNotClippedAndElseFromTheVoltage) {
  Session session = two_pairs_and_a_repeat();
  const auto clipped = step_damping(session);  // the derivative's kick reaches the limit
  ASSERT_TRUE(clipped) << clipped.error().message;
  EXPECT_TRUE(clipped->from_voltage);
  session.recordings.erase(session.recordings.begin());
  const auto within = step_damping(session);
  ASSERT_TRUE(within) << within.error().message;
  EXPECT_FALSE(within->from_voltage);
  EXPECT_EQ(within->constant.damping.size(), 1u);
  EXPECT_EQ(within->piecewise.damping.size(), 6u);
  EXPECT_NEAR(within->piecewise.model[Parameter::voltage_gain], 1.9165, 0.02 * 1.9165);
}

TEST(StepDamping, ThePageShowsItOrSaysWhyNot) {
  Session session = two_pairs_and_a_repeat();
  const auto page_of = [&session] { return identification_page({session, {}, {}, "test"}).to_html(); };
  const std::string with = page_of();
  for (const char* part : {"Law: C(v) =", "one step, six intervals", "Against speed"})
    EXPECT_NE(with.find(part), std::string::npos) << part;
  for (Recording& recording : session.recordings) recording.experiment = "track";
  const std::string without = page_of();
  EXPECT_EQ(without.find("Law: C(v) ="), std::string::npos);
  EXPECT_NE(without.find("Nothing from the integral method on one step: no recording"), std::string::npos);
}

TEST(ParametersTable, HasARowForWhateverAnyColumnHoldsAndADashWhereOneSaysNothing) {
  const Table table = parameters_table(
      "", {column_of("a", cart_with_exponential_damping()), column_of("b", cart_with_viscous_friction())});
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0][2].text, "1.9165");
  EXPECT_EQ(table.rows[1][0].text, "viscous friction, coefficient");
  EXPECT_EQ(table.rows[1][1].text, "1/s");
  EXPECT_EQ(table.rows[1][2].text, "–");
  EXPECT_EQ(table.rows[1][3].text, "6.152");
}

TEST(ParametersTable, ShowsTheIntervalsThatAModelHas) {
  NamedModel model{"a", cart_with_viscous_friction()};
  model.intervals = {{Parameter::viscous_coefficient, 6.1, 6.2}};
  const Table table = parameters_table("", {column_of(model)});
  EXPECT_EQ(table.rows[0][2].interval, "");
  EXPECT_NE(table.rows[1][2].interval.find("6.1"), std::string::npos);
}

TEST(Summary, DistanceFromTheTruthIsThatOfTheFarthestNumberOfTheSameTerms) {
  Model near = cart_with_exponential_damping();
  near.set(Parameter::exponential_gamma, 1.02 * near[Parameter::exponential_gamma]);
  EXPECT_EQ(farthest_from(cart_with_exponential_damping(), cart_with_exponential_damping()), 0.0);
  EXPECT_NEAR(farthest_from(cart_with_exponential_damping(), near).value(), 0.02, 1e-12);
  EXPECT_EQ(farthest_from(cart_with_exponential_damping(), cart_with_viscous_friction()), std::nullopt);
}

TEST(Unit, EveryNumberOfTheVocabularyIsShownWithoutUnderscores) {
  for (const ParameterInfo& parameter : parameters()) {
    EXPECT_EQ(words_of(parameter.key).find('_'), std::string::npos) << parameter.key;
  }
  EXPECT_EQ(unit_of("acceleration_m_per_s2"), "m/s²");
  EXPECT_EQ(unit_of("relative_difference"), "");
}

TEST(IdentificationPage, AForeignSessionIsIdentifiedFromItsVoltageUnlessModelsAreGiven) {
  Session session = two_pairs_and_a_repeat();
  const Model cart = cart_with_viscous_friction();
  session.recordings = {step(cart, session.rig, "foreign.csv", 60, 0)};
  session.recordings[0].controller = {};
  const std::string page = identification_page({session, {}, {}, "test"}).to_html();
  for (const char* part : {"all recordings", "voltage gain", "viscous friction, coefficient"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  const std::string given = identification_page({session, {{"linear", cart}}, {}, "test"}).to_html();
  EXPECT_EQ(given.find("all recordings"), std::string::npos);
  for (double& y_m : session.recordings[0].y_m) y_m = 0;
  EXPECT_NE(
      identification_page({session, {}, {}, "test"}).to_html().find("Nothing from the recorded voltage"),
      std::string::npos);
}

TEST(IdentificationPage, TheSameSessionGivesTheSameBytes) {
  const IdentificationPage content{two_pairs_and_a_repeat(),
                                   {{"linear", cart_with_viscous_friction()}},
                                   cart_with_exponential_damping(),
                                   "test"};
  const std::string page = identification_page(content).to_html();
  EXPECT_TRUE(page == identification_page(content).to_html());
  for (const char* part : {"In short", "a file given to the report", "Kp 60 V/m, Kd 0 V s/m",
                           "Kp 80 V/m, Kd 5 V s/m", "repeat.csv", "exponential damping"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace cartwright::report
