#include "host/diagnose/diagnosis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using test::battery;
using test::IndependentCart;
using test::nominal;
using P = Parameter;

const Estimate* found(const Diagnosis& d, Parameter id) {
  for (const Effect& effect : d.effects) {
    for (const auto& [key, e] : effect.parameters) {
      if (key == id) return &e;
    }
  }
  return nullptr;
}

struct Concealed {
  const char* name;
  Term term;
  Parameter parameter;
  double truth, tolerance;  // the tolerance is relative: what a form slightly off and 32 s of data allow
  std::function<void(IndependentCart&)> conceal;
};

std::ostream& operator<<(std::ostream& out, const Concealed& c) {
  return out << c.name;
}

class NamesWhatWasConcealed : public testing::TestWithParam<Concealed> {};

TEST_P(NamesWhatWasConcealed, AndSaysHowLargeItIs) {
  IndependentCart cart;
  GetParam().conceal(cart);
  const Diagnosis d = diagnose(battery(cart), nominal());
  ASSERT_EQ(d.verdict, Verdict::missing_physics);
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(info(d.effects.front().term).name, info(GetParam().term).name);
  EXPECT_GT(d.effects.front().confidence, 0.9);
  const Estimate* value = found(d, GetParam().parameter);
  ASSERT_NE(value, nullptr);
  EXPECT_NEAR(value->value, GetParam().truth, GetParam().tolerance * std::abs(GetParam().truth));
  // Predicts a recording that it was not chosen and not fitted with.
  EXPECT_LT(d.held_out.with_effects, 0.5 * d.held_out.refitted);
  EXPECT_LE(d.noise_floor_m, d.used.with_effects);
}

INSTANTIATE_TEST_SUITE_P(
    Terms, NamesWhatWasConcealed,
    testing::Values(
        Concealed{"constant_force", Term::constant_force, P::constant_acceleration, 0.1, 0.02,
                  [](IndependentCart& c) { c.push = [](double, double, double) { return 0.1; }; }},
        Concealed{"quadratic_drag", Term::quadratic_drag, P::drag_coefficient, 2, 0.03,
                  [](IndependentCart& c) {
                    c.push = [](double, double, double v) { return -2 * v * std::abs(v); };
                  }},
        Concealed{
            "cable_spring", Term::cable_spring, P::spring_stiffness, 5, 0.03,
            [](IndependentCart& c) { c.push = [](double, double y, double) { return -5 * (y - 0.02); }; }},
        Concealed{"cogging", Term::cogging, P::cogging_amplitude, 0.4, 0.03,
                  [](IndependentCart& c) {
                    c.push = [](double, double y, double) {
                      return 0.4 * std::sin(2 * M_PI * y / 0.021 + 1);
                    };
                  }},
        Concealed{"position_dependent_friction", Term::position_dependent_friction, P::spot_peak, 0.6, 0.05,
                  [](IndependentCart& c) {
                    c.extra_level = [](double, double y, double, double) {
                      return 0.6 * std::exp(-0.5 * std::pow((y - 0.05) / 0.02, 2));
                    };
                  }},
        Concealed{"stribeck_friction", Term::stribeck_friction, P::stribeck_excess, 0.35, 0.05,
                  [](IndependentCart& c) {
                    c.extra_level = [](double, double, double v, double) {
                      return 0.35 * std::exp(-std::pow(v / 0.05, 2));
                    };
                  }},
        Concealed{"input_dead_zone", Term::input_dead_zone, P::dead_zone_half_width, 0.2, 0.03,
                  [](IndependentCart& c) {
                    c.amplifier = [](double u) { return std::abs(u) < 0.2 ? 0 : u - std::copysign(0.2, u); };
                  }},
        Concealed{"voltage_saturation", Term::voltage_saturation, P::saturation_limit, 4, 0.02,
                  [](IndependentCart& c) {
                    c.amplifier = [](double u) { return std::min(std::max(u, -4.0), 4.0); };
                  }},
        Concealed{"transport_delay", Term::transport_delay, P::transport_delay, 0.003, 0.02,
                  [](IndependentCart& c) { c.delay_ticks = 3; }},
        Concealed{
            "amplifier_gain_asymmetry", Term::amplifier_gain_asymmetry, P::amplifier_gain_difference, 0.1,
            0.03,
            [](IndependentCart& c) { c.amplifier = [](double u) { return u > 0 ? 1.05 * u : 0.95 * u; }; }},
        Concealed{"encoder_eccentricity", Term::encoder_eccentricity, P::eccentricity_amplitude, 1.2e-4, 0.03,
                  [](IndependentCart& c) {
                    c.encoder_error_m = [](double y) { return 1.2e-4 * std::sin(2 * M_PI * y / 0.04 + 0.5); };
                  }}),
    [](const auto& one) { return one.param.name; });

class FindsNothingWhereThereIsNothing : public testing::TestWithParam<std::uint64_t> {};

TEST_P(FindsNothingWhereThereIsNothing, OnEffectFreeSessions) {
  IndependentCart cart;
  cart.seed = GetParam();
  if (GetParam() % 2 == 0) cart.coulomb_m_per_s2 = 0.25;  // less sticking
  const Diagnosis d = diagnose(battery(cart), nominal(1.93, 4.9, cart.coulomb_m_per_s2 * 1.03));
  EXPECT_EQ(name(d.verdict), "no_mismatch");
  EXPECT_TRUE(d.effects.empty());
  EXPECT_FALSE(d.unexplained.has_value());
  // The nominal terms come out right, whatever feedback, rounding and noise do.
  for (const NominalParameter& p : d.parameters) {
    const double truth = p.id == P::voltage_gain          ? cart.gain_m_per_s2_V
                         : p.id == P::viscous_coefficient ? cart.viscous_per_s
                                                          : cart.coulomb_m_per_s2;
    EXPECT_NEAR(p.refitted.value, truth, 0.01 * truth) << dotted_name(p.id);
  }
}

/// Half a count is much against what moves at the beginning of a recording.
TEST_P(FindsNothingWhereThereIsNothing, OnCoarseEncodersAtLowRates) {
  IndependentCart cart;
  cart.seed = GetParam();
  cart.sample_rate_hz = 500, cart.count_m = 1e-4;
  cart.start_m = 0.45 * cart.count_m;
  const Diagnosis d = diagnose(battery(cart), nominal(1.93, 4.9, cart.coulomb_m_per_s2 * 1.03));
  EXPECT_EQ(name(d.verdict), "no_mismatch");
  EXPECT_TRUE(d.effects.empty());
}

/// A simulation's readings are rounded and nothing else: where the cart stands all are wrong by the same.
TEST_P(FindsNothingWhereThereIsNothing, OnReadingsThatAreOnlyRounded) {
  IndependentCart cart;
  cart.seed = GetParam();
  cart.noise = GetParam() % 3 == 0 ? 0.3 : 0;
  cart.coulomb_m_per_s2 = 0.15 + 0.1 * static_cast<double>(GetParam());
  cart.start_m = 0.4 * cart.count_m;
  const Diagnosis d = diagnose(battery(cart), nominal(1.9, 5, cart.coulomb_m_per_s2));
  EXPECT_EQ(name(d.verdict), "no_mismatch");
  EXPECT_TRUE(d.effects.empty());
}

/// Friction hides the disturbance of a cart that rests, and its readings say the same again and again.
TEST_P(FindsNothingWhereThereIsNothing, OnPositioningMoves) {
  IndependentCart cart;
  cart.seed = GetParam();
  cart.count_m = std::array{2.275e-5, 1e-4, 5e-4}[GetParam() % 3];
  cart.reading_noise_counts = 0, cart.disturbance_m_per_s2 = 0.1;
  const Diagnosis d = diagnose(test::moves(cart), nominal(1.93, 4.9, cart.coulomb_m_per_s2 * 1.03));
  EXPECT_EQ(name(d.verdict), "no_mismatch");
  EXPECT_TRUE(d.effects.empty());
}

INSTANTIATE_TEST_SUITE_P(Seeds, FindsNothingWhereThereIsNothing, testing::Range<std::uint64_t>(1, 7));

TEST(Diagnosis, ValuesThatAreOffAreNoMissingPhysics) {
  const Diagnosis d = diagnose(battery({}), nominal(1.9 * 1.2));
  EXPECT_EQ(name(d.verdict), "parameters_only");
  EXPECT_TRUE(d.effects.empty());
}

TEST(Diagnosis, RefusesAVibrationThatNoTermExplains) {
  IndependentCart cart;
  cart.push = [](double t, double, double) { return 0.5 * std::sin(2 * M_PI * 9.3 * t); };
  const Diagnosis d = diagnose(battery(cart), nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_TRUE(d.effects.empty());
  ASSERT_TRUE(d.unexplained.has_value());
  const std::vector<double>& frequency_hz = d.unexplained->where.at("frequency_hz");
  ASSERT_EQ(frequency_hz.size(), 2u);
  EXPECT_NEAR(frequency_hz[0], 9.3, 0.3);
}

TEST(Diagnosis, RefusesFrictionThatWarmsUp) {
  IndependentCart cart;
  cart.extra_level = [](double t, double, double, double) { return 0.4 * std::exp(-t / 1.5); };
  const Diagnosis d = diagnose(battery(cart), nominal(1.9, 5, 0.5));
  EXPECT_EQ(name(d.verdict), "unexplained");
  ASSERT_TRUE(d.unexplained.has_value());
  EXPECT_FALSE(d.unexplained->where.at("time_s").empty());
}

/// Its edges are in the likelihood; in how far the cart gets they are next to nothing.
TEST(Diagnosis, ASpotOfFrictionWithSharpEdgesIsStillASpot) {
  IndependentCart cart;
  cart.extra_level = [](double, double y, double, double) { return std::abs(y - 0.03) < 0.02 ? 0.3 : 0.0; };
  const Diagnosis d = diagnose(battery(cart), nominal());
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().term, Term::position_dependent_friction);
  EXPECT_LT(d.effects.front().confidence, 0.7);
  EXPECT_TRUE(d.unexplained.has_value());
}

/// Its ends look like steps of the reading.
TEST(Diagnosis, APushThatBeginsAndEndsSuddenlyIsAllThereIs) {
  IndependentCart cart;
  cart.seed = 508;  // the ends of this one were taken for lost counts
  Session session = battery(cart);
  cart.push = [](double t, double, double) { return t > 1.7 && t < 1.95 ? 3.0 : 0.0; };
  session.recordings[3] = battery(cart).recordings[3];
  const Diagnosis d = diagnose(session, nominal());
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().term, Term::external_disturbance);
  EXPECT_EQ(d.model.disturbance_recording, session.recordings[3].file);
}

TEST(Diagnosis, FindsAPushInTheRecordingItWouldHaveKeptOut) {
  Session session = battery({});
  IndependentCart pushed;
  pushed.push = [](double t, double, double) {
    return t > 1.5 && t < 1.7 ? 2 * std::pow(std::sin(M_PI * (t - 1.5) / 0.2), 2) : 0.0;
  };
  const Session other = battery(pushed);
  const std::string file = session.recordings.back().file;
  session.recordings.back() = other.recordings.back();
  const Diagnosis d = diagnose(session, nominal());
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().term, Term::external_disturbance);
  EXPECT_EQ(d.model.disturbance_recording, file);
  EXPECT_NEAR(d.model[P::disturbance_start], 1.5, 0.01);
  EXPECT_NEAR(d.model[P::disturbance_peak], 2, 0.1);
  const std::vector<double>& when_s = d.effects.front().where.at("time_s");
  ASSERT_EQ(when_s.size(), 2u);
  EXPECT_NEAR(when_s.front(), 1.5, 0.01);
  EXPECT_NEAR(when_s.back(), 1.7, 0.01);
  EXPECT_TRUE(d.held_out_recordings.empty());
}

TEST(Diagnosis, KeepsARecordingOutWhereWhatTheModelMissesLooksLikeAPushEverywhere) {
  IndependentCart cart;
  cart.push = [](double, double y, double) {  // bumpers at both ends
    return -3000 * std::copysign(std::max(0.0, std::abs(y) - 0.06), y);
  };
  const Diagnosis d = diagnose(battery(cart), nominal());
  EXPECT_EQ(name(d.verdict), "unexplained");
  EXPECT_EQ(d.held_out_recordings.size(), 1u);
}

TEST(Diagnosis, NamesCoggingWithEachOfItsPeriods) {
  IndependentCart cart;
  cart.push = [](double, double y, double) {
    return 0.4 * std::sin(2 * M_PI * y / 0.021 + 1) + 0.1 * std::sin(2 * M_PI * y / 0.007 - 0.5);
  };
  const Diagnosis d = diagnose(battery(cart), nominal());
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(d.effects.front().term, Term::cogging);
  EXPECT_FALSE(d.unexplained.has_value());
  const Estimate* period = found(d, P::cogging_second_period);
  ASSERT_NE(period, nullptr);
  EXPECT_NEAR(period->value, 0.007, 2e-5);
  EXPECT_NEAR(d.model[P::cogging_period], 0.021, 2e-5);
  EXPECT_NEAR(d.model[P::cogging_second_amplitude], 0.1, 0.01);
  EXPECT_EQ(d.model[P::cogging_third_amplitude], 0);
}

TEST(Diagnosis, NamesTwoEffectsAtOnce) {
  IndependentCart cart;
  cart.delay_ticks = 4;
  cart.push = [](double, double, double) { return -0.1; };
  const Diagnosis d = diagnose(battery(cart), nominal());
  ASSERT_EQ(d.effects.size(), 2u);
  EXPECT_EQ(d.effects[0].term, Term::transport_delay);
  EXPECT_EQ(d.effects[1].term, Term::constant_force);
}

}  // namespace
}  // namespace cartwright
