#include "host/relay/sinefit.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <array>
#include <string>

#include "tests/unit/relay/covers.hpp"
#include "tests/unit/relay/sine_signals.hpp"

namespace cartwright {
namespace {

using test::angle_between;
using test::covers;
using test::SineSignal;
constexpr double kTwoPi = 2 * std::numbers::pi;
const int kDraws = test::draws(4000);

bool phase_covered(const Estimate& phase, double truth_rad) {
  return !phase.has_interval() || std::abs(angle_between(phase.value, truth_rad)) <= phase.high - phase.value;
}

/// Cramer-Rao bound of (amplitude, frequency, phase) with the offset unknown as well, for noise of
/// variance 1.
Eigen::Vector4d bound(const SineSignal& s) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int i = 0; i < s.samples; ++i) {
    const double t = s.start_s + s.period_s * i, angle = kTwoPi * s.frequency_hz * t + s.phase_rad;
    const Eigen::Vector4d row(std::sin(angle), s.amplitude * std::cos(angle) * kTwoPi * t,
                              s.amplitude * std::cos(angle), 1);
    information += row * row.transpose();
  }
  return information.inverse().diagonal();
}

double noise_for(double amplitude, double snr_db) {
  return amplitude * std::sqrt(0.5 * std::pow(10, -snr_db / 10));
}

TEST(SineFit, ReachesTheCramerRaoBoundFrom40To0Decibels) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), periods(4, 150);
  for (const double snr_db : {40.0, 20.0, 10.0, 3.0, 0.0}) {
    Eigen::Vector3d excess = Eigen::Vector3d::Zero();
    const int n = std::max(kDraws, 4000);
    for (int i = 0; i < n; ++i) {
      SineSignal s{.amplitude = 2, .phase_rad = angle(random), .offset = 0.7, .noise = noise_for(2, snr_db)};
      s.frequency_hz = periods(random) / (s.samples * s.period_s);
      const auto data = s.draw(random);
      const auto fit = sinefit(data.t_s, data.y);
      ASSERT_TRUE(fit) << fit.error().message;
      const Eigen::Vector3d error(fit->amplitude.value - s.amplitude,
                                  fit->frequency_hz.value - s.frequency_hz,
                                  angle_between(fit->phase_rad.value, s.phase_rad));
      excess += error.cwiseProduct(error).cwiseQuotient(bound(s).head<3>()) / (s.noise * s.noise * n);
    }
    for (int k = 0; k < 3; ++k)
      EXPECT_THAT(excess(k), testing::DoubleNear(1.0, 0.1)) << snr_db << " dB, value " << k;
  }
}

TEST(SineFit, FindsTheRightPeakAtZeroDecibelsWhateverTheFrequency) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), periods(2, 195);
  int gross = 0;
  const int n = std::max(kDraws, 100000);
  for (int i = 0; i < n; ++i) {
    SineSignal s{.phase_rad = angle(random), .offset = -3, .noise = noise_for(1, 0)};
    const double record_s = s.samples * s.period_s;
    s.frequency_hz = periods(random) / record_s;
    const auto data = s.draw(random);
    const auto fit = sinefit(data.t_s, data.y);
    if (!fit || std::abs(fit->frequency_hz.value - s.frequency_hz) * record_s > 1) ++gross;
  }
  EXPECT_LT(gross, 1e-4 * n);
}

TEST(SineFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), periods(1.6, 40),
      snr(0, 50);
  std::array<int, 4> inside{};
  for (int i = 0; i < kDraws; ++i) {
    SineSignal s{.phase_rad = angle(random),
                 .offset = 5,
                 .start_s = 3,
                 .jitter_s = 0.002,
                 .noise = noise_for(1, snr(random))};
    s.frequency_hz = periods(random) / (s.samples * s.period_s);
    const auto data = s.draw(random);
    const auto fit = sinefit(data.t_s, data.y);
    ASSERT_TRUE(fit) << fit.error().message;
    inside[0] += covers(fit->amplitude, s.amplitude);
    inside[1] += covers(fit->frequency_hz, s.frequency_hz);
    inside[2] += phase_covered(fit->phase_rad, s.phase_rad);
    inside[3] += covers(fit->offset, s.offset);
  }
  for (const int count : inside) EXPECT_NEAR(count / static_cast<double>(kDraws), 0.95, 0.015);
}

TEST(SineFit, IntervalsStayHonestWithColouredNoiseAndQuantisation) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), periods(3, 12),
      unit(0, 1);
  for (const bool quantised : {false, true}) {
    std::array<int, 3> inside{};
    const int n = kDraws / 4;
    for (int i = 0; i < n; ++i) {
      SineSignal s{.phase_rad = angle(random), .offset = unit(random), .samples = 2000};
      s.frequency_hz = periods(random) / (s.samples * s.period_s);
      if (quantised) {
        s.step = 0.02 + 0.3 * unit(random);
      } else {
        s.noise = 0.05;
        s.noise_pole = 0.95;
      }
      const auto data = s.draw(random);
      const auto fit = sinefit(data.t_s, data.y);
      ASSERT_TRUE(fit) << fit.error().message;
      inside[0] += covers(fit->amplitude, 1);
      inside[1] += covers(fit->frequency_hz, s.frequency_hz);
      inside[2] += phase_covered(fit->phase_rad, s.phase_rad);
    }
    for (const int count : inside) EXPECT_GT(count, 0.9 * n) << (quantised ? "quantised" : "coloured");
  }
}

TEST(SineFit, RecoversCleanSignalsExactlyFromJitteringTimesWithGaps) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    SineSignal s{.amplitude = 1e-3 + unit(random),
                 .phase_rad = 6 * unit(random) - 3,
                 .offset = 10 * unit(random),
                 .start_s = 20 * unit(random),
                 .jitter_s = 0.004};
    s.third_harmonic = 0.2 * s.amplitude * unit(random);
    s.frequency_hz = (2 + 40 * unit(random)) / (s.samples * s.period_s);
    auto data = s.draw(random);
    const auto gap = static_cast<std::ptrdiff_t>(100 + 100 * unit(random));
    data.t_s.erase(data.t_s.begin() + gap, data.t_s.begin() + gap + 40);
    data.y.erase(data.y.begin() + gap, data.y.begin() + gap + 40);
    const auto fit = sinefit(data.t_s, data.y, {.frequency_hz = std::nullopt, .harmonics = 3});
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_NEAR(fit->frequency_hz.value, s.frequency_hz, 1e-8 * s.frequency_hz);
    EXPECT_NEAR(fit->amplitude.value, s.amplitude, 1e-7 * s.amplitude);
    EXPECT_NEAR(angle_between(fit->phase_rad.value, s.phase_rad), 0, 1e-5);
    EXPECT_NEAR(fit->offset.value, s.offset, 1e-7);
    ASSERT_EQ(fit->harmonics.size(), 2U);
    EXPECT_NEAR(fit->harmonics[1].amplitude.value, s.third_harmonic, 1e-6 * s.amplitude);
    EXPECT_LT(fit->rms, 1e-7 * s.amplitude);
  }
}

TEST(SineFit, NeverGivesAConfidentWrongAnswerBelowOnePeriod) {
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), periods(0.05, 1),
      snr(0, 60);
  int wrong = 0;
  for (int i = 0; i < kDraws / 4; ++i) {
    SineSignal s{.phase_rad = angle(random), .offset = 1, .noise = noise_for(1, snr(random))};
    s.frequency_hz = periods(random) / (s.samples * s.period_s);
    const auto data = s.draw(random);
    const auto fit = sinefit(data.t_s, data.y);
    if (fit && !covers(fit->frequency_hz, s.frequency_hz)) ++wrong;
  }
  EXPECT_LT(wrong, 0.05 * kDraws / 4);
  SineSignal half{.frequency_hz = 0.25};
  const auto data = half.draw(random);
  const auto refused = sinefit(data.t_s, data.y);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("0.50 of a period"));
}

TEST(SineFit, SeparatesATrendFromTheSine) {
  std::mt19937_64 random(17);
  SineSignal s{.frequency_hz = 1.3, .phase_rad = 0.4, .offset = 2, .trend_per_s = 8, .noise = 0.1};
  const auto data = s.draw(random);
  const auto fit = sinefit(data.t_s, data.y);
  ASSERT_TRUE(fit) << fit.error().message;
  ASSERT_TRUE(fit->trend_per_s.has_value());
  EXPECT_TRUE(covers(*fit->trend_per_s, 8));
  EXPECT_TRUE(covers(fit->frequency_hz, 1.3));
  EXPECT_TRUE(covers(fit->amplitude, 1));
  EXPECT_NEAR(fit->offset.value, 2 + 8 * fit->middle_s, 0.05);
}

TEST(SineFit, ShiftingTheClockChangesThePhaseAlone) {
  std::mt19937_64 random(18);
  SineSignal s{.frequency_hz = 3.3, .phase_rad = 1.1, .noise = 0.2};
  auto data = s.draw(random);
  const auto fit = sinefit(data.t_s, data.y);
  for (double& t : data.t_s) t += 64;
  const auto shifted = sinefit(data.t_s, data.y);
  ASSERT_TRUE(fit && shifted);
  EXPECT_NEAR(shifted->frequency_hz.value, fit->frequency_hz.value, 1e-9);
  EXPECT_NEAR(shifted->amplitude.value, fit->amplitude.value, 1e-9);
  EXPECT_NEAR(
      angle_between(shifted->phase_rad.value, fit->phase_rad.value - kTwoPi * 64 * fit->frequency_hz.value),
      0, 1e-6);
  // So far from the record the phase is known no better than the frequency times that distance.
  EXPECT_GT(shifted->phase_rad.high - shifted->phase_rad.low, 5 * (fit->phase_rad.high - fit->phase_rad.low));
}

TEST(SineFit, AKnownFrequencyLeavesALinearProblem) {
  std::mt19937_64 random(19);
  SineSignal s{.amplitude = 3, .frequency_hz = 0.3, .phase_rad = -2, .offset = 4};
  const auto data = s.draw(random);  // 0.6 of a period: enough where the frequency is given
  const auto fit = sinefit(data.t_s, data.y, {.frequency_hz = 0.3});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_NEAR(fit->amplitude.value, 3, 1e-8);
  EXPECT_NEAR(fit->phase_rad.value, -2, 1e-8);
  EXPECT_FALSE(fit->frequency_hz.has_interval());
}

TEST(SineFit, RefusesWhatHoldsNoSine) {
  std::mt19937_64 random(20);
  SineSignal noise{.amplitude = 0, .noise = 1};
  const auto data = noise.draw(random);
  const auto from_noise = sinefit(data.t_s, data.y);
  ASSERT_FALSE(from_noise);
  EXPECT_THAT(from_noise.error().message, testing::HasSubstr("no sine stands out of the noise"));
  const std::vector<double> still(data.t_s.size(), 0.25);
  EXPECT_FALSE(sinefit(data.t_s, still));
  auto reversed = data;
  std::swap(reversed.t_s[5], reversed.t_s[6]);
  EXPECT_FALSE(sinefit(reversed.t_s, reversed.y));
  auto with_gap = data;
  with_gap.y[7] = std::nan("");
  EXPECT_FALSE(sinefit(with_gap.t_s, with_gap.y));
  EXPECT_FALSE(sinefit(std::vector<double>{0, 1, 2}, std::vector<double>{0, 1, 0}));
  EXPECT_FALSE(sinefit(data.t_s, data.y, {.frequency_hz = -1}));
}

}  // namespace
}  // namespace cartwright
