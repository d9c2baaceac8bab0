// Tuning rules against the frequency response they are made for, and on relay tests of a simulated cart.
#include "host/design/tuning_rules.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/design/published.hpp"

namespace cartwright::design {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

Complex response(const SimpleCart& cart, double w) {
  const Complex s(0, w);
  return cart.gain_m_per_s2_V / (s * (s + cart.damping_per_s)) * std::exp(-s * cart.dead_time_s);
}

constexpr SimpleCart kCart{1.8, 5, 0.004};

TEST(UltimatePoint, IsWhereTheLoopJustOscillates) {
  const auto u = ultimate_point(kCart);
  ASSERT_TRUE(u);
  const Complex loop = u->gain_V_per_m * response(kCart, 2 * pi / u->period_s);
  EXPECT_NEAR(loop.real(), -1, 1e-9);
  EXPECT_NEAR(loop.imag(), 0, 1e-9);
}

TEST(UltimatePoint, IsNoneWithoutDampingOrDeadTime) {
  EXPECT_FALSE(ultimate_point({1.8, 0, 0.004}));
  EXPECT_FALSE(ultimate_point({1.8, 5, 0}));
}

TEST(PhaseMarginGains, PutTheCrossoverAtTheRelayFrequencyWithThatMargin) {
  // A limit cycle as the describing function has it: G(j w) N = -1 with the relays' N.
  const double w = 12, amplitude_m = 0.02;
  const Complex g = response({1.8, 5, 0}, w);
  const Complex n = -1.0 / g;  // 4 (h1 - j h2)/(pi a)
  const RelayFeature feature{n.real() * pi * amplitude_m / 4, -n.imag() * pi * amplitude_m / 4, amplitude_m,
                             w};
  ASSERT_GT(feature.h2_V, 0);
  const Gains gains = phase_margin_gains(feature, pi / 3, false);
  const Complex loop = Complex(gains.kp_V_per_m, w * gains.kd_V_s_per_m) * g;
  EXPECT_NEAR(std::abs(loop), 1, 1e-9);
  EXPECT_NEAR(std::arg(loop), -pi + pi / 3, 1e-9);
}

TEST(CriticallyDamped, HasItsPolesWhereItSaysWithAndWithoutIntegral) {
  const double w = 15;
  for (const bool integral : {false, true}) {
    const Gains g = critically_damped(kCart, w, integral);
    for (const double s : integral ? std::vector{-w, -w / 5} : std::vector{-w}) {
      const double beta = kCart.gain_m_per_s2_V;
      const double value = s * s * s + (kCart.damping_per_s + beta * g.kd_V_s_per_m) * s * s +
                           beta * g.kp_V_per_m * s + beta * g.ki_V_per_m_s;
      EXPECT_NEAR(value, 0, 1e-8);
    }
  }
}

TEST(NaturalFrequency, JustMeetsWhatIsAskedOnTheIdealLoop) {
  const SimpleCart cart{1.7866, 4.5866, 0};
  const auto metrics = [&](const Specification& spec) {
    const Gains gains = critically_damped(cart, natural_frequency_for(spec, {}, {}, cart), false);
    return step_metrics(test::lm3(), gains, Loop::continuous(1e-4),
                        {.duration_s = 3, .settling_band = spec.settling_band, .bandwidth = true});
  };
  Specification settle, rise, wide;
  settle.settling_band = 0.01;
  settle[Quantity::settling_time] = 0.45;
  rise[Quantity::rise_time] = 0.2;
  wide[Quantity::bandwidth] = 2;
  EXPECT_NEAR(metrics(settle).settling_time_s, 0.45, 1e-3);
  EXPECT_NEAR(metrics(rise).rise_time_s, 0.2, 1e-3);
  EXPECT_NEAR(metrics(wide).bandwidth_hz, 2, 0.01);
}

TEST(CompareRules, FindsTheCartInItsSimulatedRelayTests) {
  Model model = test::lm3();
  model.set(Parameter::coulomb_level, 0.3);
  Specification spec;
  spec[Quantity::settling_time] = 0.5;
  const Trials trials(sample_scenarios(model, {}), {}, {.duration_s = 1.5}, spec);
  const auto compared = compare_rules(trials, simulated_relay_session(model, trials.loop), true, false);
  EXPECT_THAT(compared.remarks, testing::IsEmpty());
  std::vector<const TuningRule*> damped;
  int margins = 0;
  for (const TuningRule& rule : compared.rules) {
    if (rule.name == "critically damped") damped.push_back(&rule);
    margins += rule.name == "phase margin 60°";
  }
  EXPECT_EQ(margins, 3);
  // From the model and from the limit cycles by the describing function, which is off by some per cent.
  ASSERT_EQ(damped.size(), 2u);
  EXPECT_NEAR(damped[1]->gains.kp_V_per_m / damped[0]->gains.kp_V_per_m, 1, 0.06);
  EXPECT_NEAR(damped[1]->gains.kd_V_s_per_m / damped[0]->gains.kd_V_s_per_m, 1, 0.2);
}

TEST(CompareRules, SaysWhyARelayTestIsRefused) {
  Session session = simulated_relay_session(test::lm3(), {});
  for (Recording& recording : session.recordings) {
    std::fill(recording.y_m.begin(), recording.y_m.end(), 0);  // never moved
  }
  Specification spec;
  spec[Quantity::rise_time] = 0.2;
  const Trials trials(sample_scenarios(test::lm3(), {}), {}, {}, spec);
  const auto compared = compare_rules(trials, session, false, false);
  EXPECT_THAT(compared.remarks, testing::SizeIs(4));
  EXPECT_THAT(compared.remarks, testing::Contains(testing::HasSubstr("refused")));
}

}  // namespace
}  // namespace cartwright::design
