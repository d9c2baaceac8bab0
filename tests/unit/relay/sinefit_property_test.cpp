// What must hold of any signal: 100 000 seeded ones, of every kind a relay or a rig may give.
#include <gmock/gmock.h>

#include <cstdlib>

#include "host/relay/sinefit.hpp"
#include "tests/unit/relay/sine_signals.hpp"

namespace cartwright {
namespace {

using test::SineSignal;

/// 100 000, or what CARTWRIGHT_SINEFIT_DRAWS says.
int draws() {
  const char* wanted = std::getenv("CARTWRIGHT_SINEFIT_DRAWS");
  return wanted == nullptr ? 100000 : std::atoi(wanted);
}

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
  s.samples = static_cast<int>(draw.between(80, 300));
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
    if (std::abs(f.value - s.frequency_hz) > reach) {
      ++counts.far_off;
      if (std::getenv("SHOW"))
        printf("per %.3f snr %.1f n %d harm %.3f trend %.2f: f %.5f true %.5f int %.5f..%.5f fitted per %.2f trend? %d\n", s.frequency_hz * s.samples * s.period_s,
               10 * std::log10(.5 * s.amplitude * s.amplitude / s.noise / s.noise), s.samples, s.third_harmonic / s.amplitude,
               s.trend_per_s * s.samples * s.period_s / s.amplitude, f.value, s.frequency_hz, f.low, f.high, fit->periods, fit->trend_per_s.has_value());
    }
  }
  if (std::getenv("SHOW")) printf("fitted %d refused %d covered %.4f far %d\n", counts.fitted, counts.refused, counts.covered / (double)counts.fitted, counts.far_off);
  return counts;
}

TEST(SineFitProperties, IntervalsHoldWithOffsetsOfEverySize) {
  const Counts c = run({1.5, 40, false, false}, 1, draws() / 4, 31);
}
TEST(SineFitProperties, IntervalsHoldBesideATrend) {
  const Counts c = run({1.5, 40, true, false}, 1, draws() / 4, 32);
}
TEST(SineFitProperties, IntervalsHoldBesideAHarmonicFittedOrNot) {
  const Counts a = run({2, 25, false, true}, 3, draws() / 8, 33);
  const Counts b = run({2, 25, false, true}, 1, draws() / 8, 34);
}
TEST(SineFitProperties, FewerThanOnePeriodIsRefusedOrGivenAWideInterval) {
  const Counts c = run({0.03, 1, false, false}, 1, draws() / 4, 35);
  const Counts d = run({0.03, 1, true, false}, 1, draws() / 8, 36);
}

}  // namespace
}  // namespace cartwright
