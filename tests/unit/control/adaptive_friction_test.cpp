#include "common/control/adaptive_friction.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "common/control/compensation.hpp"
#include "common/model/plant.hpp"

namespace cartwright {
namespace {

using E = AdaptiveEstimates;

constexpr double kA = -10.5, kB = 0.1429, kF1 = 10;  // Section 5 of the relay paper

AdaptiveSettings paper_law() {
  AdaptiveSettings s;
  s.lambda1_per_s2 = 100;
  s.lambda2_per_s = 20;
  s.kv_per_s = 300;
  s.dead_zone_m_per_s = 1e-3;
  s.speed_filter_hz = 1e9;  // the paper has the speed itself
  s.rate.value = {50, 1e-2, 100, 50, 0};
  s.initial.value = {-5, 0.05, 6.9979, 0, 0};
  s.least.value = {-100, 1e-3, -100, -100, 0};
  s.greatest.value = {100, 1, 100, 100, 100};
  s.measured_velocity = s.own_feedback = true;
  return s;
}

TEST(AdaptiveFriction, TheLyapunovFunctionOfTheProofFalls) {
  // Eq. (32) along the closed loop of Eq. (10), (24)-(30), by small steps: never up by more than the step's
  // own error, and down in all.
  constexpr double kPeriod_s = 1e-5;
  const AdaptiveSettings settings = paper_law();
  AdaptiveFriction law(settings, kPeriod_s);
  Plant plant(
      Model(1 / kB).set(Parameter::viscous_coefficient, -kA / kB).set(Parameter::coulomb_level, kF1 / kB));
  plant.reset(0.01);
  const auto lyapunov = [&] {
    const E& e = law.estimates();
    const double s = law.sliding_m_per_s(), zone = settings.dead_zone_m_per_s;
    const double outside = s - std::clamp(s, -zone, zone);
    const double sum = kA - e[E::a] + e[E::f2];  // a and f2 act as one number
    return 0.5 * (kB * outside * outside + sum * sum / (2 * settings.rate[E::a]) +
                  (kB - e[E::b]) * (kB - e[E::b]) / settings.rate[E::b] +
                  (kF1 - e[E::f1]) * (kF1 - e[E::f1]) / settings.rate[E::f1]);
  };
  double first = 0, lowest = 1e9, worst_rise = 0;
  for (int tick = 0; tick < 300'000; ++tick) {
    const double t = tick * kPeriod_s, w = std::numbers::pi;
    const ReferenceMotion reference{0.1 * std::sin(w * t), 0.1 * w * std::cos(w * t),
                                    -0.1 * w * w * std::sin(w * t)};
    plant.advance(law.update(reference, reference.position_m, plant.state().position_m, false), kPeriod_s);
    const double now = lyapunov();
    if (tick == 2) first = now;
    if (tick >= 2) {
      lowest = std::min(lowest, now);
      worst_rise = std::max(worst_rise, now - lowest);
    }
  }
  EXPECT_LT(lowest, 0.75 * first);
  EXPECT_LT(worst_rise, 0.01 * first);
}

/// A machine that follows its reference to within white noise: nothing to learn.
struct Idle {
  explicit Idle(const AdaptiveSettings& settings) : law(settings, 1e-3) {}

  void run(double duration_s, double noise_m) {
    std::normal_distribution<double> noise(0, noise_m);
    for (int tick = 0; tick < duration_s * 1e3; ++tick, ++ticks) {
      const double t = ticks * 1e-3, w = std::numbers::pi;
      const double r = 0.1 * std::sin(w * t);
      law.update({r, 0.1 * w * std::cos(w * t), -w * w * r}, r, r + noise(random), false);
    }
  }
  AdaptiveFriction law;
  std::mt19937_64 random{1};
  int ticks = 0;
};

AdaptiveSettings cart_law() {
  AdaptiveSettings s;
  s.rate.value = {20, 1, 5, 0, 5};
  s.dead_zone_m_per_s = 1e-4;  // far inside the noise
  return adaptive_about(Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5),
                        s, 1, 12);
}

TEST(AdaptiveFriction, NoiseWalksTheEstimatesAwayAsPrintedAndNotAsBuilt) {
  constexpr double kNoise_m = 2e-5;
  AdaptiveSettings printed = cart_law();
  printed.measured_velocity = true;
  printed.speed_filter_hz = 1e9;  // plain differences
  printed.leakage_per_s = 0;
  printed.least.value = {-100, -100, -100, -100, -100};
  printed.greatest.value = {100, 100, 100, 100, 100};
  Idle as_printed(printed), as_built(cart_law());
  as_printed.run(600, kNoise_m);
  as_built.run(600, kNoise_m);
  const E start = cart_law().initial;
  EXPECT_GT(std::abs(as_printed.law.estimates()[E::a] - start[E::a]), 0.5 * std::abs(start[E::a]));
  EXPECT_GT(as_printed.law.estimates()[E::f], 1) << "Eq. (31) only grows";
  EXPECT_LT(std::abs(as_built.law.estimates()[E::a] - start[E::a]), 0.05 * std::abs(start[E::a]));
  EXPECT_LT(std::abs(as_built.law.estimates()[E::f1] - start[E::f1]), 0.2 * start[E::f1]);
  EXPECT_LE(as_built.law.estimates()[E::f], cart_law().greatest[E::f]);
}

TEST(AdaptiveFriction, TheBoundLeaksAwayOnceTheErrorIsGone) {
  Idle idle(cart_law());
  idle.run(10, 1e-3);
  const double grown = idle.law.estimates()[E::f];
  ASSERT_GT(grown, 0.01);
  idle.run(30, 0);
  EXPECT_LT(idle.law.estimates()[E::f], 0.06 * grown);  // e^(-0.1 30) = 0.05
}

TEST(AdaptiveFriction, HoldsEveryEstimateInsideItsLimitsAndRemembersWhichItMet) {
  const AdaptiveSettings settings = cart_law();
  AdaptiveFriction law(settings, 1e-3);
  EXPECT_EQ(law.limits_met(), 0);
  for (int tick = 0; tick < 20'000; ++tick) law.update({0, 0.3, 0}, 0.3, 0, false);  // always far behind
  EXPECT_EQ(law.estimates()[E::f1], settings.greatest[E::f1]);
  EXPECT_EQ(law.estimates()[E::a], settings.least[E::a]);
  EXPECT_EQ(law.limits_met() & 0b101U, 0b101U);
  for (int tick = 0; tick < 20'000; ++tick) law.update({0, 0.3, 0}, -0.01, 0, false);
  EXPECT_LT(law.estimates()[E::f1], settings.greatest[E::f1]);
  EXPECT_EQ(law.limits_met() & 0b101U, 0b101U) << "sticky";
}

TEST(AdaptiveFriction, LearnsNothingWhileTheOutputIsLimited) {
  AdaptiveFriction law(cart_law(), 1e-3);
  for (int tick = 0; tick < 1000; ++tick) law.update({0, 0.3, 1}, 0.3, 0, true);
  EXPECT_EQ(law.estimates().value, cart_law().initial.value);
}

}  // namespace
}  // namespace cartwright
