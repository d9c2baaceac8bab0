#include "host/diagnose/search/plausible.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

using P = Parameter;

/// What a session must show of a cart's travel and encoder.
SessionFacts of_a_rail() {
  SessionFacts facts;
  facts.count_m = 2e-5;
  facts.position_low_m = -0.2, facts.position_high_m = 0.2;
  facts.most_speed_m_per_s = 0.5;
  return facts;
}

Session session() {
  Session session;
  session.rig.encoder_resolution_m = of_a_rail().count_m;
  return session;
}

/// A coupling whose load has this share of the mass, told that well.
bool coupling(double load_share, double standard_error) {
  Fit fit;
  fit.model = Model(2.0).set(P::coupling_resonance, 12).set(P::coupling_load_share, load_share);
  fit.free = {free_parameter(P::coupling_load_share, of_a_rail(), fit.model)};
  fit.covariance.setConstant(1, 1, standard_error * standard_error);
  return plausible(fit, Term::flexible_coupling, session(), of_a_rail());
}

TEST(Plausible, ACouplingIsOfTwoMasses) {
  EXPECT_TRUE(coupling(0.5, 0.01));
  EXPECT_FALSE(coupling(0.97, 0.0001)) << "at its bound";
  EXPECT_FALSE(coupling(0.965, 0.004)) << "not told from its bound";
  EXPECT_FALSE(coupling(0.035, 0.004)) << "nor from the other one";
  EXPECT_TRUE(coupling(0.965, 0.001)) << "told from it";
  EXPECT_TRUE(coupling(0.8, 0.3)) << "that little is known of a share says nothing against it";
  EXPECT_TRUE(coupling(0.9699, 0.3)) << "wherever a fit left it";
  EXPECT_TRUE(coupling(0.97, 0.3)) << "even at its bound";
}

/// An encoder that turns so many radii off its own axis, on a wheel of a 60 mm circumference.
bool encoder(double eccentricity) {
  constexpr double kPeriod_m = 0.06;
  Fit fit;
  fit.model = Model(2.0)
                  .set(P::eccentricity_period, kPeriod_m)
                  .set(P::eccentricity_amplitude, eccentricity * kPeriod_m / (2 * M_PI));
  return plausible(fit, Term::encoder_eccentricity, session(), of_a_rail());
}

TEST(Plausible, FrictionThatIsNotSeenToFallOffIsCoulombs) {
  const auto only = [](Term term, Parameter width, double value) {
    Fit fit;
    fit.model = Model(2.0).set(P::stribeck_excess, 0.1).set(P::spot_peak, 0.1).set(width, value);
    fit.model.set(P::coulomb_level, 0.3);
    EXPECT_TRUE(plausible(fit, term, session(), of_a_rail()));
    fit.model.remove(Term::coulomb_friction);
    return plausible(fit, term, session(), of_a_rail());
  };
  const SessionFacts facts = of_a_rail();
  EXPECT_TRUE(only(Term::stribeck_friction, P::stribeck_speed, 0.4 * facts.most_speed_m_per_s));
  EXPECT_FALSE(only(Term::stribeck_friction, P::stribeck_speed, 0.6 * facts.most_speed_m_per_s));
  EXPECT_TRUE(only(Term::position_dependent_friction, P::spot_width, 0.1 * facts.travel_m()));
  EXPECT_FALSE(only(Term::position_dependent_friction, P::spot_width, 0.4 * facts.travel_m()));
}

TEST(Plausible, AnEncoderTurnsNearlyAboutItsAxis) {
  EXPECT_TRUE(encoder(0.02));
  EXPECT_FALSE(encoder(0.4));
  EXPECT_FALSE(encoder(0.0005)) << "less than half a count";
}

}  // namespace
}  // namespace cartwright
