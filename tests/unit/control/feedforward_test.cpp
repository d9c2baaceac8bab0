#include "common/control/feedforward.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "common/model/plant.hpp"

namespace cartwright {
namespace {

constexpr double kPeriod_s = 1e-4;

double sine_m(double time_s) {
  return 0.08 * std::sin(2 * std::numbers::pi * time_s) + 0.02 * std::sin(7 * time_s);
}

/// How far open-loop feed-forward from `known` leaves the reference within a second on the cart `truth`.
double greatest_error_m(const Model& truth, const Model& known) {
  const FeedForward law(known, kPeriod_s);
  Plant plant(truth);
  plant.reset(0, (sine_m(1e-7) - sine_m(-1e-7)) / 2e-7);
  double worst = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    const double t = tick * kPeriod_s;
    const double r0 = sine_m(t), r1 = sine_m(t + kPeriod_s / 2), r2 = sine_m(t + kPeriod_s);
    worst = std::max(worst, std::abs(plant.state().position_m - r0));
    plant.advance(law.voltage_V({r1, (r2 - r0) / kPeriod_s, (r2 - 2 * r1 + r0) * 4 / kPeriod_s / kPeriod_s}),
                  kPeriod_s);
  }
  return worst;
}

Model plain() {
  return Model(1.9).set(Parameter::viscous_coefficient, 3);
}

struct Case {
  Term term;
  Model model;
};

std::vector<Case> cases() {
  using P = Parameter;
  const auto with = [](std::initializer_list<std::pair<P, double>> values) {
    Model m = plain();
    for (const auto& [parameter, value] : values) m.set(parameter, value);
    return m;
  };
  return {{Term::viscous_friction, plain()},
          {Term::coulomb_friction, with({{P::coulomb_level, 0.5}})},
          {Term::exponential_damping,
           with({{P::exponential_alpha1, 3}, {P::exponential_alpha2, 5}, {P::exponential_gamma, 1}})},
          {Term::stribeck_friction, with({{P::stribeck_excess, 0.3}, {P::stribeck_speed, 0.1}})},
          {Term::constant_force, with({{P::constant_acceleration, 0.4}})},
          {Term::asymmetric_viscous_friction, with({{P::asymmetric_viscous_difference, 0.4}})},
          {Term::position_dependent_friction,
           with({{P::spot_peak, 0.6}, {P::spot_centre, 0.02}, {P::spot_width, 0.02}})},
          {Term::cogging, with({{P::cogging_amplitude, 0.5}, {P::cogging_period, 0.016}})},
          {Term::input_dead_zone, with({{P::dead_zone_half_width, 0.3}})},
          {Term::cable_spring, with({{P::spring_stiffness, 8}, {P::spring_neutral, 0.05}})},
          {Term::quadratic_drag, with({{P::drag_coefficient, 3}})},
          {Term::amplifier_gain_asymmetry, with({{P::amplifier_gain_difference, 0.2}})}};
}

TEST(FeedForward, MovesACartAlongItsReferenceForEveryTermItKnows) {
  for (const Case& each : cases()) {
    SCOPED_TRACE(info(each.term).name);
    ASSERT_TRUE(each.model.has(each.term));
    const double with = greatest_error_m(each.model, each.model);
    EXPECT_LT(with, 5e-5);
    Model known = each.model;
    known.remove(each.term);
    EXPECT_GT(greatest_error_m(each.model, known), 20 * with) << "the term matters, and is what helped";
  }
}

TEST(FeedForward, KnowsExactlyTheTermsOfTheseCases) {
  std::vector<Term> known;
  for (const TermInfo& term : terms()) {
    if (has_inverse(term.id)) known.push_back(term.id);
  }
  std::vector<Term> tested;
  for (const Case& each : cases()) tested.push_back(each.term);
  EXPECT_THAT(tested, testing::UnorderedElementsAreArray(known));
}

TEST(FeedForward, NamesWhatItLeavesOutAndDoesTheRest) {
  Model model = plain();
  model.set(Parameter::transport_delay, 5e-3).set(Parameter::backlash_gap, 1e-4);
  model.set(Parameter::saturation_limit, 3);
  EXPECT_THAT(without_inverse(model),
              testing::ElementsAre(Term::backlash, Term::voltage_saturation, Term::transport_delay));
  const ReferenceMotion motion{0.01, 0.2, 1};
  EXPECT_EQ(FeedForward(model, 1e-3).voltage_V(motion), FeedForward(plain(), 1e-3).voltage_V(motion));
}

TEST(FeedForward, IsSilentAtRestAndWithoutAModel) {
  Model model = plain();
  model.set(Parameter::coulomb_level, 0.5).set(Parameter::dead_zone_half_width, 0.3);
  EXPECT_EQ(FeedForward(model, 1e-3).voltage_V({0.1, 0, 0}), 0);
  EXPECT_EQ(FeedForward().voltage_V({0.1, 1, 1}), 0);
}

TEST(MeanDirection, IsTheMeanOfTheSignOverAHold) {
  // Turning in the middle of the hold, a quarter after its start, and far away.
  EXPECT_EQ(mean_direction({0, 0, 3}, 1e-3), 0);
  EXPECT_NEAR(mean_direction({0, 0.25e-3, 1}, 1e-3), 0.5, 1e-12);
  EXPECT_EQ(mean_direction({0, -0.2, 1}, 1e-3), -1);
  EXPECT_EQ(mean_direction({0, 0, 0}, 1e-3), 0);
}

}  // namespace
}  // namespace cartwright
