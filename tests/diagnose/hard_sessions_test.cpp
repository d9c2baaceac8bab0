#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "host/diagnose/diagnosis.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using test::battery;
using test::IndependentCart;
using test::nominal;
using testing::Contains;
using testing::HasSubstr;
using P = Parameter;

TEST(HardSessions, AWrongSignIsSaidAndNothingIsNamed) {
  Session session = battery({});
  for (Recording& r : session.recordings) {
    for (double& y : r.y_m) y = -y;
  }
  const Diagnosis d = diagnose(session, nominal());
  EXPECT_EQ(name(d.verdict), "parameters_only");
  EXPECT_NEAR(d.model[P::voltage_gain], -1.9, 0.01);
  EXPECT_THAT(d.remarks, Contains(HasSubstr("reversed")));
}

TEST(HardSessions, RecordingsOfTwoCartsGetNoName) {
  Session session = battery({});
  IndependentCart heavier;
  heavier.gain_m_per_s2_V = 1.6;
  heavier.viscous_per_s = 4;
  heavier.seed = 2;
  const Session other = battery(heavier);
  for (std::size_t n = 1; n < session.recordings.size(); n += 2) session.recordings[n] = other.recordings[n];
  const Diagnosis d = diagnose(session, nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_TRUE(d.effects.empty());
}

TEST(HardSessions, TheOneRecordingOfAnotherCartIsPointedAt) {
  Session session = battery({});
  IndependentCart heavier;
  heavier.gain_m_per_s2_V = 1.6;
  const Session other = battery(heavier);
  session.recordings[2] = other.recordings[2];
  const Diagnosis d = diagnose(session, nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_THAT(d.remarks, Contains(HasSubstr("most in " + session.recordings[2].file)));
}

TEST(HardSessions, ANominalModelThatIsWildlyOffIsOnlyOff) {
  const Diagnosis d =
      diagnose(battery({}), Model(40).set(P::viscous_coefficient, 0.1).set(P::coulomb_level, 3));
  EXPECT_EQ(name(d.verdict), "parameters_only");
  EXPECT_NEAR(d.model[P::voltage_gain], 1.9, 0.01);
  EXPECT_NEAR(d.model[P::viscous_coefficient], 5, 0.05);
  EXPECT_NEAR(d.model[P::coulomb_level], 0.4, 0.01);
}

/// A motor turned at 30 mm/s by a servo, whose current is reported late and with noise: the forces nearly
/// balance, and what is known of them predicts less than that the speed stays.
Session slow_servo(const std::function<double(double y_m)>& push_m_per_s2) {
  constexpr double kStep_s = 1e-4, kRate_per_s = 500, kSpeed_m_per_s = 0.03, kGain = 40, kFriction = 7;
  constexpr double kDuration_s = 8;
  Recording r;
  r.file = "slow.csv";
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise;
  double y = 0, v = kSpeed_m_per_s, integral_A = 0;
  std::vector<double> current_A;
  for (std::size_t step = 0; static_cast<double>(step) * kStep_s < kDuration_s; ++step) {
    const double error = kSpeed_m_per_s - v;
    integral_A = std::clamp(integral_A + 200 * error * kStep_s, -3.0, 3.0);
    current_A.push_back(5 * error + integral_A);
    v += kStep_s *
         (kGain * current_A.back() + push_m_per_s2(y) - std::copysign(kFriction, v) + 20 * noise(random));
    y += kStep_s * v;
    const auto row = static_cast<std::size_t>(std::lround(1 / (kRate_per_s * kStep_s)));
    if (step % row != 0) continue;
    r.t_s.push_back(static_cast<double>(step) * kStep_s);
    r.y_m.push_back(y + 5e-5 * noise(random));
    r.u_V.push_back(current_A[step - std::min<std::size_t>(step, 40)] + 0.03 * noise(random));
  }
  Session session;
  session.rig.sample_rate_hz = kRate_per_s;
  session.rig.encoder_resolution_m = 1e-5;
  session.recordings = {std::move(r)};
  return session;
}

Diagnosis diagnosis_of_slow(const Session& session) {
  DiagnoseOptions options;
  options.held = {P::voltage_gain};
  return diagnose(session, Model(40).set(P::viscous_coefficient, 0).set(P::coulomb_level, 10), options);
}

TEST(HardSessions, TheDriveOfAServoThatHoldsTheSpeedTellsTheCogging) {
  const Diagnosis d = diagnosis_of_slow(slow_servo([](double y) {
    double push = 0;
    for (int n = 1; n <= 6; ++n) push += 15.0 / n * std::sin(2 * M_PI * n * y / 0.03 + n * n);
    return push;
  }));
  EXPECT_EQ(name(d.verdict), "missing_physics");
  ASSERT_EQ(d.effects.size(), 1U);
  EXPECT_EQ(d.effects.front().term, Term::cogging);
  for (const std::size_t n : {1U, 2U}) {
    const PeriodicTerm& wave = kCoggingWaves[n - 1];
    EXPECT_NEAR(d.model[wave.period] * static_cast<double>(n), 0.03, 1e-4);
    EXPECT_NEAR(d.model[wave.amplitude] * static_cast<double>(n), 15, 1.5);
    EXPECT_GT(std::cos(d.model[wave.phase] - static_cast<double>(n * n)), 0.95);
  }
  EXPECT_NEAR(d.model[P::coulomb_level], 7, 2);
  EXPECT_TRUE(std::isnan(d.parameters.front().refitted.low));  // of the gain nothing is told
}

TEST(HardSessions, ForcesThatPredictLessThanAnUnchangedSpeedGetNoName) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::array<double, 50> bumps{};
  for (double& height : bumps) height = 20 * normal(random);
  const Diagnosis d = diagnosis_of_slow(slow_servo([&](double y) {
    double push = 0;
    for (std::size_t i = 0; i < bumps.size(); ++i)
      push += bumps[i] * std::exp(-0.5 * std::pow((y - 0.005 * static_cast<double>(i)) / 0.003, 2));
    return push;
  }));
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_TRUE(d.effects.empty());
  ASSERT_TRUE(d.unexplained.has_value());
  EXPECT_THAT(d.unexplained->why_refused, HasSubstr("keeps its speed"));
}

/// A lag and a limit together come near it, the noise takes in the rest.
TEST(HardSessions, AnAmplifierThatSlewsGetsNoName) {
  IndependentCart cart;
  double slewed_V = 0;
  cart.amplifier = [&slewed_V](double u) {
    constexpr double kSlew_V = 0.2;  // in a tick
    return slewed_V += std::clamp(u - slewed_V, -kSlew_V, kSlew_V);
  };
  const Diagnosis d = diagnose(battery(cart), nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_TRUE(d.effects.empty());
}

TEST(HardSessions, APlugThatIsLooseGetsNoName) {
  IndependentCart cart;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  int loose_ticks = 0;
  cart.amplifier = [&](double u) {
    if (uniform(random) < 1.5e-3) loose_ticks = 20;
    return loose_ticks-- > 0 ? 0 : u;
  };
  const Diagnosis d = diagnose(battery(cart), nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_TRUE(d.effects.empty());
}

TEST(HardSessions, OneRecordingIsEnoughToSayThatNothingIsMissingAndSaysWhatItCannot) {
  Session session = battery({});
  session.recordings.resize(1);
  const Diagnosis d = diagnose(session, nominal());
  EXPECT_EQ(name(d.verdict), "no_mismatch");
  EXPECT_TRUE(d.held_out_recordings.empty());
  EXPECT_THAT(d.remarks, Contains(HasSubstr("nothing could be held out")));
}

TEST(HardSessions, StribeckFrictionDoesNotStandInForWhatEveryCartHas) {
  IndependentCart cart;
  cart.gain_m_per_s2_V = 2.17;
  cart.viscous_per_s = 4.4;
  cart.coulomb_m_per_s2 = 0.7;
  cart.push = [](double, double, double v) { return -5 * v * std::abs(v); };
  const Diagnosis d = diagnose(battery(cart), Model(2.13).set(P::viscous_coefficient, 4.4));
  EXPECT_EQ(name(d.verdict), "missing_physics");
  std::vector<Term> named;
  for (const Effect& effect : d.effects) named.push_back(effect.term);
  EXPECT_THAT(named, testing::UnorderedElementsAre(Term::coulomb_friction, Term::quadratic_drag));
}

}  // namespace
}  // namespace cartwright
