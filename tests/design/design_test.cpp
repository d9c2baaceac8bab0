// The search: what it proposes holds, where nothing can hold it says why, and diagnosed models go in
// unchanged.
#include "host/design/design.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/design/published.hpp"

namespace cartwright::design {
namespace {

Specification settle(double time_s, double band, double overshoot) {
  Specification spec;
  spec.settling_band = band;
  spec[Quantity::settling_time] = time_s;
  spec[Quantity::overshoot] = overshoot;
  return spec;
}

/// A coarser search than the command's, for speed.
Design search(const Trials& trials, bool integral = false, double kp = 0) {
  auto settings = default_search(trials.scenarios.front().model, trials.loop, trials.step,
                                 trials.specification, integral);
  settings.quarters = integral ? 6 : 10;
  settings.threads = 2;
  if (kp > 0) settings.kp = {kp, kp};
  return search_gains(trials, settings);
}

std::vector<ParameterInterval> nlm3_intervals() {
  return {{Parameter::voltage_gain, 1.89, 1.93},
          {Parameter::exponential_alpha1, 14.5, 16},
          {Parameter::exponential_gamma, 3.6, 4.0}};
}

TEST(SearchGains, ProposesWhatHoldsOnEveryCartAndWithGainsALittleOff) {
  const Model model = test::nlm3();
  const Loop loop{.encoder_resolution_m = 2.275e-5};
  const Trials trials(sample_scenarios(model, nlm3_intervals()), loop, {.duration_s = 1.5},
                      settle(0.5, 0.01, 0.05));
  const Design design = search(trials);
  ASSERT_TRUE(design.found);
  EXPECT_TRUE(design.has_margin);
  EXPECT_TRUE(design.may_change);
  // Carts that were not in the sample.
  for (const Scenario& cart : sample_scenarios(model, nlm3_intervals(), 12, 99)) {
    EXPECT_TRUE(judge(trials.specification, trials.metrics(cart, design.gains)).met());
  }
  Gains off = design.gains;
  off.kp_V_per_m *= 1.05;
  off.kd_V_s_per_m *= 0.95;
  EXPECT_TRUE(trials.all_meet(off));
  const Estimate& settled = design.prediction.quantities[static_cast<std::size_t>(Quantity::settling_time)];
  EXPECT_LE(settled.low, settled.value);
  EXPECT_LT(settled.value, settled.high);
  EXPECT_LE(settled.high, 0.9 * 0.5);
}

TEST(SearchGains, AtFixedKpKeepsOutOfTheGapBetweenTheTwoIntervals) {
  Specification spec;
  spec.settling_band = 0.01;
  spec[Quantity::settling_time] = 0.5;
  const Trials trials(sample_scenarios(test::nlm3(), {}), Loop::continuous(), {.duration_s = 1.5}, spec);
  const Design design = search(trials, false, 100);
  ASSERT_TRUE(design.found);
  EXPECT_TRUE(design.may_change);
  const GainMap& map = design.maps.front();
  ASSERT_EQ(map.columns(), 1u);
  const auto meets = [&](double kd) {
    const auto nearest =
        std::min_element(map.points().begin(), map.points().end(), [kd](const auto& a, const auto& b) {
          const auto off = [kd](const MapPoint& p) {
            return p.tried ? std::abs(p.gains.kd_V_s_per_m - kd) : 1e9;
          };
          return off(a) < off(b);
        });
    return nearest->holds();
  };
  EXPECT_FALSE(meets(2));
  EXPECT_TRUE(meets(4.3));
  EXPECT_FALSE(meets(6));
  EXPECT_TRUE(meets(9));
  EXPECT_GT(design.gains.kd_V_s_per_m, 7.5);
}

TEST(SearchGains, SaysWhichLimitBindsAndWhatCouldBeHad) {
  const Trials trials(sample_scenarios(test::lm3(), {}), {}, {.duration_s = 0.5}, settle(0.05, 0.02, 0.05));
  const Design design = search(trials);
  EXPECT_FALSE(design.found);
  EXPECT_FALSE(design.model_alone);
  EXPECT_EQ(design.worst.binding, Quantity::settling_time);
  ASSERT_EQ(design.achievable.size(), 1u);  // without the overshoot limit it would be no better
  EXPECT_EQ(design.achievable[0].quantity, Quantity::settling_time);
  // Twelve volts cannot move a cart of 1.8 m/s^2/V by 0.1 m and stop it in less: bang-bang needs
  // 2 sqrt(0.1/(12 beta)).
  EXPECT_GT(design.achievable[0].best, 2 * std::sqrt(0.98 * 0.1 / (12 * 1.7866)) * 0.9);
  EXPECT_LT(design.achievable[0].best, 0.5);
}

TEST(SearchGains, TellsAModelThatMeetsItFromCartsThatDoNot) {
  const Trials trials(sample_scenarios(test::lm3(), {{Parameter::voltage_gain, 0.3, 6}}), {},
                      {.duration_s = 1}, settle(0.3, 0.02, 0.02));
  const Design design = search(trials);
  EXPECT_FALSE(design.found);
  EXPECT_TRUE(design.model_alone);
  EXPECT_FALSE(design.worst.met());
  EXPECT_TRUE(design.worst.binding);
}

TEST(SearchGains, TakesPidWhereATiltedRailDefeatsPd) {
  Model model = test::lm3();
  model.set(Parameter::constant_acceleration, 4);
  const Trials trials(sample_scenarios(model, {}), {}, {.duration_s = 2.5}, settle(1, 0.005, 0.2));
  EXPECT_FALSE(search(trials).found);
  const Design pid = search(trials, true);
  ASSERT_TRUE(pid.found);
  EXPECT_GT(pid.gains.ki_V_per_m_s, 0);
  EXPECT_GT(pid.maps.size(), 1u);
}

TEST(SearchGains, TakesModelsWithDiagnosedEffectsUnchanged) {
  Model model = test::lm3();
  model.set(Parameter::coulomb_level, 0.3)
      .set(Parameter::stribeck_excess, 0.2)
      .set(Parameter::stribeck_speed, 0.02)
      .set(Parameter::backlash_gap, 4e-4)
      .set(Parameter::transport_delay, 0.004)
      .set(Parameter::heating_gain_loss, 0.1)
      .set(Parameter::heating_time_constant, 60)
      .set(Parameter::eccentricity_amplitude, 2e-5)
      .set(Parameter::eccentricity_period, 0.02)
      .set(Parameter::eccentricity_phase, 0);
  const Trials trials(sample_scenarios(model, {{Parameter::backlash_gap, 3e-4, 5e-4}}),
                      {.encoder_resolution_m = 2.275e-5}, {.duration_s = 1.5}, settle(0.6, 0.02, 0.1));
  const Design design = search(trials);
  ASSERT_TRUE(design.found);
  EXPECT_TRUE(trials.all_meet(design.gains));
}

TEST(Scenarios, StayWithinIntervalsAndBoundsAndReachEveryEnd) {
  const std::vector<ParameterInterval> intervals = {{Parameter::voltage_gain, 1.7, 1.9},
                                                    {Parameter::viscous_coefficient, -1, 6}};
  double least_c = 1e9, most_c = -1e9, least_b = 1e9, most_b = -1e9;
  const auto carts = sample_scenarios(test::lm3(), intervals);
  EXPECT_EQ(carts.front().model[Parameter::voltage_gain], 1.7866);
  for (const Scenario& cart : carts) {
    least_b = std::min(least_b, cart.model[Parameter::voltage_gain]);
    most_b = std::max(most_b, cart.model[Parameter::voltage_gain]);
    least_c = std::min(least_c, cart.model[Parameter::viscous_coefficient]);
    most_c = std::max(most_c, cart.model[Parameter::viscous_coefficient]);
  }
  EXPECT_EQ(least_b, 1.7);
  EXPECT_EQ(most_b, 1.9);
  EXPECT_EQ(least_c, 0);  // damping is not negative
  EXPECT_EQ(most_c, 6);
}

TEST(Scenarios, OfEveryTermOfTheVocabularyCanBeStepped) {
  for (const TermInfo& term : terms()) {
    Model model(1.9);
    model.set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.2);
    for (const ParameterInfo& p : parameters_of(term.id)) {
      model.set(p.id, std::clamp(0.05, p.lower, std::min(p.upper, 1.0)));
    }
    const Trials trials(sample_scenarios(model, {}), {}, {.duration_s = 0.5}, settle(1, 0.02, 0.1));
    const StepMetrics metrics = trials.metrics(trials.scenarios.front(), {60, 3, 0});
    EXPECT_TRUE(std::isfinite(metrics.final_error)) << term.name;
    EXPECT_LT(std::abs(metrics.final_error), 1.5) << term.name;
  }
}

TEST(Outline, ClosesAroundARegionAndIsAsLongAsItsEdge) {
  Specification spec;
  spec[Quantity::settling_time] = 0.4;
  const Trials trials(sample_scenarios(test::lm3(), {}), Loop::continuous(), {.duration_s = 1}, spec);
  const GainMap map(trials, {50, 150}, {2, 12}, {}, 3, 1);
  std::vector<char> inside(map.columns() * map.rows(), 0);
  inside[0] = inside[1] = inside[map.columns() * 5 + 5] = 1;  // two cells in a corner, and one alone
  const Outline line = outline(map, inside);
  EXPECT_EQ(std::count_if(line.y.begin(), line.y.end(), [](double y) { return std::isnan(y); }), 2);
  EXPECT_EQ(line.x.size(), 6 + 1 + 1 + 4 + 1 + 1u);
}

}  // namespace
}  // namespace cartwright::design
