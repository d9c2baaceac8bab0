#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/diagnose/diagnosis.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using test::battery;
using test::IndependentCart;
using testing::Contains;
using testing::HasSubstr;
using P = Parameter;

Model nominal() {
  return Model(1.87).set(P::viscous_coefficient, 5.2).set(P::coulomb_level, 0.41);
}

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

TEST(HardSessions, ANominalModelThatIsWildlyOffIsOnlyOff) {
  const Diagnosis d =
      diagnose(battery({}), Model(40).set(P::viscous_coefficient, 0.1).set(P::coulomb_level, 3));
  EXPECT_EQ(name(d.verdict), "parameters_only");
  EXPECT_NEAR(d.model[P::voltage_gain], 1.9, 0.01);
  EXPECT_NEAR(d.model[P::viscous_coefficient], 5, 0.05);
  EXPECT_NEAR(d.model[P::coulomb_level], 0.4, 0.01);
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
