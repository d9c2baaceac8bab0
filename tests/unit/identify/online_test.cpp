#include "common/identify/online.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"

namespace cartwright {
namespace {

constexpr double kStep_m = 2.275e-5, kLimit_V = 12;

Model cart(double friction = 0.5) {
  return Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, friction);
}

OnlineSetup setup(double period_s) {
  OnlineSetup out;
  out.rows = {period_s, kStep_m};
  out.voltage_limit_V = kLimit_V;
  return out;
}

/// A cart under PD or PID that follows two slow sines, shaken by a coloured disturbance.
struct Shaken {
  double disturbance_m_per_s2 = 0, amplitude_m = 0.1;
  PdGains gains{80, 2, 50, false};
  double ki_V_per_m_s = 0;
  Model truth = cart();
  bool with_twin = true;
  double period_s = 1e-3;
  std::uint64_t seed = 1;

  OnlineEstimates run(double duration_s) const {
    OnlineIdentification online(setup(period_s));
    if (with_twin) {
      online.begin({gains, ki_V_per_m_s});
    } else {
      online.end();
    }
    Plant plant(truth);
    plant.reset(0);
    Encoder encoder(truth, kStep_m);
    PidController law({gains, ki_V_per_m_s}, period_s, kLimit_V);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 1);
    double push = 0;
    const double left = std::exp(-period_s / 0.03);
    for (int tick = 0; tick < duration_s / period_s; ++tick) {
      const double t = tick * period_s, w = 2 * std::numbers::pi;
      const double r = amplitude_m * (std::sin(0.3 * w * t) + 0.5 * std::sin(0.83 * w * t));
      const double y = encoder.read(plant.state().position_m, 0, period_s);
      const double u = law.update(r, y);
      online.tick(t, y, u, r, 0);
      push = left * push + std::sqrt(1 - left * left) * disturbance_m_per_s2 * noise(random);
      plant.advance(u, period_s, push);
    }
    return online.estimates();
  }
};

TEST(OnlineIdentification, FindsAQuietCartToAThousandth) {
  const OnlineEstimates found = Shaken{}.run(60);
  EXPECT_NEAR(found.gain_m_per_s2_V.value, 1.9, 1.9e-3);
  EXPECT_NEAR(found.viscous_per_s.value, 5, 5e-3);
  EXPECT_NEAR(found.coulomb_m_per_s2.value, 0.5, 2e-3);
}

TEST(OnlineIdentification, DoesSoAtEveryRateOfTheController) {
  for (const double rate_hz : {100.0, 4000.0}) {
    Shaken cart;
    cart.period_s = 1 / rate_hz;
    cart.gains = {30, 0.5, 20, false};
    const OnlineEstimates found = cart.run(60);
    EXPECT_NEAR(found.gain_m_per_s2_V.value, 1.9, 1.9e-3) << rate_hz;
    EXPECT_NEAR(found.viscous_per_s.value, 5, 5e-3) << rate_hz;
    EXPECT_NEAR(found.coulomb_m_per_s2.value, 0.5, 2e-3) << rate_hz;
  }
}

TEST(OnlineIdentification, FeedbackBiasesTheRegressionAndTheTwinTakesTheBiasAway) {
  // Slow tracking, stiff gains: the voltage answers the disturbance as much as the reference.
  for (const double ki_V_per_m_s : {0.0, 100.0}) {
    double plain = 0, twin = 0;
    constexpr int kSeeds = 6;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      Shaken shaken;
      shaken.ki_V_per_m_s = ki_V_per_m_s;
      shaken.disturbance_m_per_s2 = 1;
      shaken.amplitude_m = 0.06;
      shaken.seed = seed;
      twin += shaken.run(120).gain_m_per_s2_V.value / 1.9 - 1;
      shaken.with_twin = false;
      plain += shaken.run(120).gain_m_per_s2_V.value / 1.9 - 1;
    }
    EXPECT_GT(std::abs(plain / kSeeds), 0.02) << ki_V_per_m_s;
    EXPECT_LT(std::abs(twin / kSeeds), std::abs(plain / kSeeds) / 4) << ki_V_per_m_s;
  }
}

TEST(OnlineIdentification, ItsIntervalsCoverTheTruth) {
  int covered = 0;
  constexpr int kSeeds = 20;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Shaken shaken;
    shaken.disturbance_m_per_s2 = 0.1;
    shaken.seed = seed;
    const OnlineEstimates found = shaken.run(40);
    const auto inside = [](const OnlineEstimate& e, double truth) {
      return e.low <= truth && truth <= e.high;
    };
    covered += inside(found.gain_m_per_s2_V, 1.9) + inside(found.viscous_per_s, 5) +
               inside(found.coulomb_m_per_s2, 0.5);
  }
  EXPECT_GE(covered, 50);  // of 60; 57 are expected
}

TEST(OnlineIdentification, ACartThatMostlySticksIsNotMistakenForOneWithMoreFriction) {
  // Small strokes on a cart with three times the friction: it stands still at every turn for long.
  Shaken sticky;
  sticky.truth = cart(1.5);
  sticky.gains = {40, 0, 50, false};
  sticky.amplitude_m = 0.04;
  const OnlineEstimates found = sticky.run(120);
  EXPECT_NEAR(found.coulomb_m_per_s2.value, 1.5, 0.015);
  EXPECT_NEAR(found.gain_m_per_s2_V.value, 1.9, 0.019);
}

TEST(OnlineIdentification, ForgetsWhatIsOlderThanItsMemory) {
  OnlineIdentifier identifier;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 1);
  const auto feed = [&](double gain, std::size_t blocks) {
    for (std::size_t i = 0; i < blocks * OnlineIdentifier::kWindowsPerBlock; ++i) {
      WeakWindow window;
      window.x = window.z = {noise(random), noise(random), noise(random)};
      window.response_m_per_s2 = gain * window.x[0] + 5 * window.x[1] + 0.5 * window.x[2];
      identifier.add(window);
      for (int tick = 0; tick < 25; ++tick) identifier.refine();
    }
  };
  feed(1.9, OnlineIdentifier::kBlocks);
  EXPECT_NEAR(identifier.estimates().gain_m_per_s2_V.value, 1.9, 1e-9);
  feed(1.5, OnlineIdentifier::kBlocks / 2);
  EXPECT_NEAR(identifier.estimates().gain_m_per_s2_V.value, 1.7, 0.02);
  feed(1.5, OnlineIdentifier::kBlocks / 2);
  EXPECT_NEAR(identifier.estimates().gain_m_per_s2_V.value, 1.5, 1e-9);
  EXPECT_EQ(identifier.estimates().windows, OnlineIdentifier::kBlocks * OnlineIdentifier::kWindowsPerBlock);
}

TEST(OnlineIdentification, GivesNoNumbersWhereTheDataGivesNone) {
  // One direction, one speed: friction and damping are one number.
  OnlineIdentifier identifier;
  for (std::size_t i = 0; i < 10 * OnlineIdentifier::kWindowsPerBlock; ++i) {
    WeakWindow window;
    window.x = window.z = {1, -0.3, -1};
    window.response_m_per_s2 = 0;
    identifier.add(window);
    identifier.refine();
  }
  EXPECT_TRUE(std::isnan(identifier.estimates().gain_m_per_s2_V.value));
}

WeakWindow window_with(double error, double drive) {
  WeakWindow window;
  window.response_m_per_s2 = error;
  window.drive_m_per_s2 = drive;
  return window;
}

TEST(ModelMonitor, JudgesByWhatTheModelLeftWhenItWasSet) {
  ModelMonitor monitor;
  for (int i = 0; i < 1000; ++i) monitor.add(window_with(i % 2 == 0 ? 0.1 : -0.1, 3));
  EXPECT_TRUE(monitor.learned());
  EXPECT_FALSE(monitor.raised());
  EXPECT_NEAR(monitor.innovation_m_per_s2(), 0.1, 1e-6);
  for (int i = 0; i < 2000; ++i) monitor.add(window_with(0.19, 3));
  EXPECT_FALSE(monitor.raised()) << "less than twice as much";
  for (int i = 0; i < 2000; ++i) monitor.add(window_with(0.22, 3));
  EXPECT_TRUE(monitor.raised());
  for (int i = 0; i < 2000; ++i) monitor.add(window_with(0.15, 3));
  EXPECT_TRUE(monitor.raised()) << "it does not flutter about its limit";
  for (int i = 0; i < 2000; ++i) monitor.add(window_with(0.1, 3));
  EXPECT_FALSE(monitor.raised());
}

TEST(ModelMonitor, NoticesAModelThatWasWrongFromTheStart) {
  ModelMonitor monitor;
  for (int i = 0; i < 70; ++i) monitor.add(window_with(0.5, 3));
  EXPECT_FALSE(monitor.raised()) << "too little to judge by";
  for (int i = 0; i < 100; ++i) monitor.add(window_with(0.5, 3));
  EXPECT_TRUE(monitor.raised());
}

}  // namespace
}  // namespace cartwright
