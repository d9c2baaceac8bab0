#include "host/relay/relay_identify.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/model/plant.hpp"
#include "host/reproduce/relay_plant.hpp"
#include "tests/unit/relay/covers.hpp"

namespace cartwright {
namespace {

using reproduce::PaperPlant;
using reproduce::relay_session;
using reproduce::rig_with;
using test::covers;
using testing::HasSubstr;

Estimate named(const std::vector<RelayReport::Value>& values, const std::string& name) {
  for (const auto& value : values) {
    if (value.name == name) return value.estimate;
  }
  ADD_FAILURE() << name << " is missing";
  return {};
}

constexpr double kSum = 1 / PaperPlant::kKp + PaperPlant::kF2;

TEST(RelayIdentify, IsExactOnThePapersPlantWithoutNoise) {
  const auto session = relay_session(PaperPlant::model(), {{2, 1.5}, {2.5, 2}, {1, 0.7}}, rig_with(1000, 0));
  const auto report = identify_from_relay(session);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR(named(report->combinations, "Tp/Kp").value, 0.02685, 1e-5 * 0.02685);
  EXPECT_NEAR(named(report->combinations, "f1").value, 0.5, 1e-5 * 0.5);
  EXPECT_NEAR(named(report->combinations, "1/Kp+f2").value, kSum, 1e-5 * kSum);
}

TEST(RelayIdentify, KeepsWithinAThousandthThroughAnEncoderOnACart) {
  const Model cart = Model(1.9)
                         .set(Parameter::viscous_coefficient, 5)
                         .set(Parameter::coulomb_level, 0.5)
                         .set(Parameter::constant_acceleration, 0.15);
  const auto session = relay_session(cart, {{2, 1.5}, {3, 2.4}}, rig_with(1000, 2.275e-5));
  const auto report = identify_from_relay(session);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR(named(report->parameters, "voltage_gain_m_per_s2_V").value, 1.9, 1.9e-3);
  EXPECT_NEAR(named(report->parameters, "viscous_friction.coefficient_per_s").value, 5, 5e-3);
  EXPECT_NEAR(named(report->parameters, "coulomb_friction.level_m_per_s2").value, 0.5, 5e-4);
  EXPECT_NEAR(named(report->parameters, "constant_force.acceleration_m_per_s2").value, 0.15, 1e-3);
}

/// Replaces a session's recordings by ones with a coloured disturbance of the given rms and clocks that
/// jitter.
Session disturbed(const Model& model, Session session, double rms_m_per_s2, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::exponential_distribution<double> late(1 / 1e-5);
  constexpr double kPole = 0.99;
  for (Recording& r : session.recordings) {
    for (double& t : r.t_s) t += std::min(late(random), 3e-4);
    const auto gains = std::get<DualRelayGains>(r.controller);
    DualRelayController law(gains, session.rig.period_s(), session.rig.voltage_limit_V);
    Plant plant(model);
    plant.reset(0, 0, r.t_s.front());
    double push = 0;
    for (std::size_t row = 0; row < r.size(); ++row) {
      const double q = session.rig.encoder_resolution_m;
      r.y_m[row] = q * std::round(plant.state().position_m / q);
      r.u_V[row] = law.update(0, r.y_m[row]);
      push = kPole * push + std::sqrt(1 - kPole * kPole) * rms_m_per_s2 * normal(random);
      if (row + 1 < r.size()) plant.advance(r.u_V[row], r.t_s[row + 1] - r.t_s[row], push);
    }
  }
  return session;
}

TEST(RelayIdentify, IntervalsHoldTheTruthUnderAColouredDisturbance) {
  const Model cart = Model(2).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.4);
  std::mt19937_64 random(5);
  const Session clean = relay_session(cart, {{2, 1.5}, {3, 2.4}}, rig_with(1000, 2.275e-5), 6);
  constexpr int kDraws = 40;
  std::array<int, 4> inside{};
  for (int i = 0; i < kDraws; ++i) {
    const auto report = identify_from_relay(disturbed(cart, clean, 0.03, random));
    ASSERT_TRUE(report) << report.error().message;
    inside[0] += covers(named(report->parameters, "voltage_gain_m_per_s2_V"), 2);
    inside[1] += covers(named(report->parameters, "viscous_friction.coefficient_per_s"), 5);
    inside[2] += covers(named(report->parameters, "coulomb_friction.level_m_per_s2"), 0.4);
    inside[3] += covers(named(report->parameters, "constant_force.acceleration_m_per_s2"), 0);
    EXPECT_NEAR(named(report->parameters, "voltage_gain_m_per_s2_V").value, 2, 0.02);
  }
  // 40 draws of a 95 % interval: fewer than 34 inside has a probability below 1 %.
  for (const int count : inside) EXPECT_GE(count, 34);
}

TEST(RelayIdentify, GivesASumWhereOneRecordingCannotTellTheFrictionsApart) {
  const Model cart = Model(2).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.4);
  std::mt19937_64 random(6);
  const auto clean = relay_session(cart, {{2, 1.5}}, rig_with(1000, 2.275e-5), 6);
  const auto report = identify_from_relay(disturbed(cart, clean, 0.06, random));
  ASSERT_TRUE(report) << report.error().message;
  for (const auto& value : report->parameters) EXPECT_THAT(value.name, testing::Not(HasSubstr("friction")));
  ASSERT_FALSE(report->not_separable.empty());
  const Combination& sum = report->not_separable.front();
  ASSERT_THAT(sum.names,
              testing::ElementsAre("viscous_friction.coefficient_per_s", "coulomb_friction.level_m_per_s2"));
  const std::string factor = sum.expression.substr(sum.expression.find("+ ") + 2);
  EXPECT_TRUE(covers(sum.estimate, 5 + std::stod(factor) * 0.4)) << sum.expression;
}

TEST(RelayIdentify, AlwaysSaysThatBackEmfAndViscousFrictionAreOneTerm) {
  const auto session = relay_session(PaperPlant::model(), {{2, 1.5}, {2.5, 2}}, rig_with(1000, 0), 6);
  const auto report = identify_from_relay(session);
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->not_separable.size(), 1U);
  EXPECT_EQ(report->not_separable[0].expression, "1/Kp + f2");
  EXPECT_TRUE(covers(report->not_separable[0].estimate, kSum) ||
              std::abs(report->not_separable[0].estimate.value - kSum) < 1e-9);
}

std::string refusal(const Session& session) {
  const auto cycle = find_limit_cycle(session.recordings.front(), session.rig);
  return cycle ? "" : cycle.error().message;
}

TEST(LimitCycle, RefusesWhatIsNoSteadyOscillationWithTheReason) {
  const Rig rig = rig_with(1000, 2.275e-5);
  const auto plant = PaperPlant::model();
  // Started away from the reference, with less relay than friction: it comes to rest.
  EXPECT_THAT(refusal(relay_session(plant, {{0.3, 0.1}}, rig)), HasSubstr("sticks"));
  EXPECT_THAT(refusal(relay_session(plant, {{1, 0.4}}, rig, 10, 0.3)), HasSubstr("dies out"));
  EXPECT_THAT(refusal(relay_session(plant, {{2, 1.5}}, rig, 1.5)), HasSubstr("cycles"));
  EXPECT_THAT(refusal(relay_session(plant, {{2, 1.5}}, rig, 3.0)), HasSubstr("converged"));
  auto drifting = relay_session(plant, {{2, 1.5}}, rig);
  for (std::size_t row = 0; row < drifting.recordings[0].size(); ++row) {
    drifting.recordings[0].y_m[row] += 0.05 * drifting.recordings[0].t_s[row];
  }
  EXPECT_THAT(refusal(drifting), HasSubstr("drifts"));
  auto moved = relay_session(plant, {{2, 1.5}}, rig);
  moved.recordings[0].r_m.back() = 1;
  EXPECT_THAT(refusal(moved), HasSubstr("reference changes"));
  auto holed = relay_session(plant, {{2, 1.5}}, rig);
  for (std::size_t row = 5000; row < holed.recordings[0].size(); ++row) holed.recordings[0].t_s[row] += 0.1;
  EXPECT_THAT(refusal(holed), HasSubstr("rows are missing"));
}

TEST(LimitCycle, ARefusedRecordingLeavesTheOthersInUse) {
  const auto session = relay_session(PaperPlant::model(), {{2, 1.5}, {1, 0.4}}, rig_with(1000, 2.275e-5));
  const auto report = identify_from_relay(session);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->recordings[0].cycle.has_value());
  EXPECT_FALSE(report->recordings[1].refused.empty());
  Session none = session;
  none.recordings.erase(none.recordings.begin());
  EXPECT_FALSE(identify_from_relay(none));
}

TEST(DescribingFunction, CorrectedEquationsReturnWhatTheyWereMadeFrom) {
  // Choose a and w, compute the relay amplitudes that N(a) G(jw) = -1 asks for, and solve back.
  constexpr double kTpOverKp = 0.03, kF1 = 0.4, kRest = 0.12;
  std::vector<RelayFeature> experiments;
  for (const auto& [a, w] : {std::pair{0.5, 9.0}, std::pair{1.1, 7.0}, std::pair{0.2, 12.0}}) {
    const double quarter = std::numbers::pi / 4 * a * w;
    experiments.push_back({quarter * w * kTpOverKp, kF1 + quarter * kRest, a, w});
  }
  const auto found = corrected_describing_function(experiments);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->tp_over_kp, kTpOverKp, 1e-12);
  EXPECT_NEAR(found->f1_V, kF1, 1e-12);
  EXPECT_NEAR(found->inverse_kp_plus_f2, kRest, 1e-12);
  EXPECT_FALSE(corrected_describing_function(std::span(experiments).first(1)));
}

TEST(DescribingFunction, IsBiasedOnThePapersPlantAsTheErrataSay) {
  const auto session = relay_session(PaperPlant::model(), {{2, 1.5}, {2.5, 2}, {1, 0.7}}, rig_with(20000, 0));
  std::vector<RelayFeature> experiments;
  for (const Recording& r : session.recordings) {
    const auto cycle = find_limit_cycle(r, session.rig);
    ASSERT_TRUE(cycle) << cycle.error().message;
    const auto gains = std::get<DualRelayGains>(r.controller);
    experiments.push_back({gains.h1_V, gains.h2_V, cycle->sine.amplitude.value,
                           2 * std::numbers::pi * cycle->sine.frequency_hz.value});
  }
  const auto corrected = corrected_describing_function(experiments);
  ASSERT_TRUE(corrected);
  EXPECT_NEAR(corrected->f1_V, 0.498, 0.002);
  EXPECT_NEAR(corrected->inverse_kp_plus_f2, 0.1154, 0.0003);
  EXPECT_NEAR(corrected->tp_over_kp, 0.0265, 0.0001);
  // What the first harmonic leaves out: 1 to 7 % that an exact match does not have.
  EXPECT_THAT(std::abs(corrected->inverse_kp_plus_f2 / kSum - 1),
              testing::AllOf(testing::Gt(0.01), testing::Lt(0.07)));
  EXPECT_THAT(std::abs(corrected->tp_over_kp / 0.02685 - 1),
              testing::AllOf(testing::Gt(0.01), testing::Lt(0.07)));
}

}  // namespace
}  // namespace cartwright
