// What must hold of any signal: close to 100 000 seeded ones, of every kind a relay or a rig may give.
#include <gmock/gmock.h>

#include <cmath>

#include "host/relay/sinefit.hpp"
#include "tests/unit/relay/sine_signals.hpp"

namespace cartwright {
namespace {

using test::SineSignal;

const int kSignals = test::draws(100000);

class Draw {
 public:
  explicit Draw(unsigned long seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random_);
  }
  double decades(double low, double high) { return std::pow(10, between(std::log10(low), std::log10(high))); }
  bool one_in(int n) { return between(0, n) < 1; }
  std::mt19937_64& random() { return random_; }

 private:
  std::mt19937_64 random_;
};

double noise_at(double amplitude, double snr_db) {
  return amplitude * std::sqrt(0.5 * std::pow(10, -snr_db / 10));
}

struct Kind {
  double least_periods, most_periods;
  bool trend, harmonic;
};

SineSignal random_signal(Draw& draw, const Kind& kind) {
  SineSignal s;
  s.samples = static_cast<int>(draw.between(80, 220));
  s.amplitude = draw.decades(1e-4, 1e3);
  s.phase_rad = draw.between(-3, 3);
  s.offset = s.amplitude * draw.between(-10, 10);
  s.start_s = draw.between(-5, 5);
  s.noise = noise_at(s.amplitude, draw.between(5, 60));
  const double record_s = s.samples * s.period_s;
  s.frequency_hz = draw.decades(kind.least_periods, kind.most_periods) / record_s;
  if (kind.trend) s.trend_per_s = s.amplitude / record_s * draw.between(-4, 4);
  if (kind.harmonic) s.third_harmonic = s.amplitude * draw.between(0.02, 0.2);
  return s;
}

struct Counts {
  int fitted = 0, refused = 0, covered = 0, far_off = 0;
};

/// Fits `count` signals; `far_off` are those wrong by more than five times their own interval.
Counts run(const Kind& kind, int harmonics, int count, unsigned long seed) {
  Draw draw(seed);
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const SineSignal s = random_signal(draw, kind);
    const auto data = s.draw(draw.random());
    const auto fit = sinefit(data.t_s, data.y, {.frequency_hz = std::nullopt, .harmonics = harmonics});
    if (!fit) {
      ++counts.refused;
      EXPECT_FALSE(fit.error().message.empty());
      continue;
    }
    ++counts.fitted;
    const Estimate& f = fit->frequency_hz;
    EXPECT_TRUE(f.low <= f.value && f.value <= f.high);
    EXPECT_GT(fit->amplitude.value, 0);
    EXPECT_GE(fit->periods, 1);
    counts.covered += f.low <= s.frequency_hz && s.frequency_hz <= f.high;
    const double reach = 5 * (s.frequency_hz > f.value ? f.high - f.value : f.value - f.low);
    counts.far_off += std::abs(f.value - s.frequency_hz) > reach;
  }
  return counts;
}

double coverage(const Counts& counts) {
  return static_cast<double>(counts.covered) / counts.fitted;
}

TEST(SineFitProperties, IntervalsHoldWithOffsetsOfEverySize) {
  const Counts c = run({1.5, 40, false, false}, 1, kSignals / 4, 31);
  EXPECT_NEAR(coverage(c), 0.95, 0.01);
  EXPECT_EQ(c.far_off, 0);
  EXPECT_LT(c.refused, 1e-3 * kSignals);
}

TEST(SineFitProperties, IntervalsHoldBesideATrend) {
  const Counts c = run({1.5, 40, true, false}, 1, kSignals * 3 / 8, 32);
  EXPECT_NEAR(coverage(c), 0.95, 0.01);
  EXPECT_EQ(c.far_off, 0);
  EXPECT_LT(c.refused, 0.03 * kSignals);  // with less than two periods, it may be a part of one on a slope
}

TEST(SineFitProperties, IntervalsHoldBesideAHarmonicFittedOrNot) {
  const Counts fitted = run({2, 12, false, true}, 3, kSignals / 16, 33);
  EXPECT_NEAR(coverage(fitted), 0.95, 0.01);
  EXPECT_EQ(fitted.far_off, 0);
  const Counts left_out = run({2, 12, false, true}, 1, kSignals / 16, 34);
  EXPECT_GT(coverage(left_out), 0.94);  // wider: what is left is not white
  EXPECT_EQ(left_out.far_off, 0);
  EXPECT_LT(fitted.refused + left_out.refused, 0.01 * kSignals);
}

TEST(SineFitProperties, FewerThanOnePeriodIsRefusedOrGivenAWideInterval) {
  for (const bool trend : {false, true}) {
    const Counts c = run({0.03, 1, trend, false}, 1, kSignals / 8, 35);
    EXPECT_EQ(c.far_off, 0);
    EXPECT_GT(c.refused, 0.99 * (c.fitted + c.refused));
  }
}

}  // namespace
}  // namespace cartwright
