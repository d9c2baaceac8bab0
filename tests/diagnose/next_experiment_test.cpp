#include "host/diagnose/judge/next_experiment.hpp"

#include <gtest/gtest.h>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// What a search would hold of a cart with one more effect: numbers as given, noise as of a 22.75 um encoder.
Explanation with(Term term, P parameter, double value, double scale) {
  Explanation one;
  one.effects = {term};
  one.fit.model = Model(1.9);
  one.fit.model.set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.4).set(parameter, value);
  one.fit.noise = {2e3, 0.005};
  one.fit.error_rms_m = 1e-5;
  one.fit.free = {{parameter, scale, 0, 1, false}};
  return one;
}

SessionFacts facts() {
  return facts_of(test::battery({}));
}

TEST(NextExperiment, ShakesACartThatMayBeLateOrSlow) {
  const Explanation late = with(Term::transport_delay, P::transport_delay, 2e-3, 1e-3);
  const Explanation slow = with(Term::armature_lag, P::armature_time_constant, 2e-3, 1e-3);
  const auto proposal = next_experiment({}, late, slow, facts(), {}, 2);
  ASSERT_TRUE(proposal);
  EXPECT_EQ(proposal->separates, "transport_delay from armature_lag");
  EXPECT_GT(proposal->expected_nats, kLeastGain);
  EXPECT_GT(proposal->chance, 0.9);
  EXPECT_EQ(proposal->experiment.substr(0, 6), "dither");
}

TEST(NextExperiment, IsNoneWhereTheTwoAreOne) {
  const Explanation one = with(Term::transport_delay, P::transport_delay, 2e-3, 1e-3);
  EXPECT_FALSE(next_experiment({}, one, one, facts(), {}, 2));
}

TEST(NextExperiment, StaysWithinTheTravel) {
  const Explanation late = with(Term::transport_delay, P::transport_delay, 2e-3, 1e-3);
  const Explanation slow = with(Term::armature_lag, P::armature_time_constant, 2e-3, 1e-3);
  Rig narrow;
  narrow.travel_m = {-1e-4, 1e-4};
  SessionFacts nowhere = facts();
  nowhere.position_low_m = -1e-4, nowhere.position_high_m = 1e-4;
  EXPECT_FALSE(next_experiment(narrow, late, slow, nowhere, {}, 2));
}

}  // namespace
}  // namespace cartwright
