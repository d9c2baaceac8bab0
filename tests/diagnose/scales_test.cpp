// Carts of other sizes and speeds: nothing that the diagnosis says may depend on units, and little on the
// rate.

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "host/diagnose/diagnosis.hpp"
#include "host/diagnose/judge/surrogate.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using P = Parameter;

test::IndependentCart with_low_speed_friction() {
  test::IndependentCart cart;
  cart.extra_level = [](double, double, double v, double) { return 0.5 * std::exp(-std::pow(v / 0.05, 2)); };
  return cart;
}

/// All lengths of a session times `scale`.
Session scaled(Session session, double scale) {
  session.rig.encoder_resolution_m *= scale;
  for (Recording& r : session.recordings) {
    for (double& y : r.y_m) y *= scale;
    for (double& wanted : r.r_m) wanted *= scale;
    if (auto* pd = std::get_if<PdGains>(&r.controller)) pd->kp_V_per_m /= scale, pd->kd_V_s_per_m /= scale;
  }
  return session;
}

TEST(Scales, UnitsOfLengthDoNotMatter) {
  constexpr double kScale = 1e-3;
  const Session session = test::battery(with_low_speed_friction());
  const Diagnosis in_metres = diagnose(session, test::nominal());
  const Diagnosis d = diagnose(scaled(session, kScale), test::nominal(1.87 * kScale, 5.2, 0.41 * kScale));
  ASSERT_EQ(in_metres.effects.size(), 1u);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().term, in_metres.effects.front().term);
  EXPECT_NEAR(d.effects.front().confidence, in_metres.effects.front().confidence, 1e-3);
  for (const P id : {P::voltage_gain, P::stribeck_excess, P::stribeck_speed})
    EXPECT_NEAR(d.model[id], kScale * in_metres.model[id], 1e-3 * kScale * in_metres.model[id]);
  EXPECT_NEAR(d.used.nominal, kScale * in_metres.used.nominal, 1e-6 * kScale * in_metres.used.nominal);
  EXPECT_NEAR(d.used.with_effects, kScale * in_metres.used.with_effects,
              1e-3 * kScale * in_metres.used.with_effects);
}

/// A heavy machine, read a hundred times a second: its coupling swings at a hertz.
TEST(Scales, ASlowMachineHasSlowCouplings) {
  test::IndependentCart slow;
  slow.sample_rate_hz = 100;
  const Model rigid = test::nominal(1.9, 5, 0.4);
  const Model truth = Model(rigid)
                          .set(P::coupling_resonance, 1.3)
                          .set(P::coupling_damping_ratio, 0.05)
                          .set(P::coupling_load_share, 0.4);
  const Session session = surrogate(test::battery(slow), truth, {2e-5, 0.02, 0.02}, 1);
  const Diagnosis d = diagnose(session, rigid);
  ASSERT_FALSE(d.effects.empty()) << name(d.verdict);
  EXPECT_EQ(d.effects.front().term, Term::flexible_coupling);
  EXPECT_NEAR(d.model[P::coupling_resonance], 1.3, 0.02);
}

}  // namespace
}  // namespace cartwright
