#include "common/model/encoder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

using P = Parameter;

TEST(Encoder, RoundsToItsResolutionAndKeepsExactPositionsWithoutOne) {
  Encoder encoder(Model(1.0), 2.275e-5);
  for (double y = -1e-3; y < 1e-3; y += 7.7e-6) {
    const double read = encoder.read(y, 0, 1e-3);
    EXPECT_LE(std::abs(read - y), 0.5 * 2.275e-5 * (1 + 1e-9));
    EXPECT_NEAR(read / 2.275e-5, std::round(read / 2.275e-5), 1e-9);
  }
  EXPECT_EQ(Encoder(Model(1.0), 0).read(1.23456789e-3, 0, 1e-3), 1.23456789e-3);
}

TEST(EncoderEccentricity, IsExactAfterWholePeriodsAndOffByItsAmplitudeAtMost) {
  const double a = 1e-4, period = 0.05;
  Encoder encoder(Model(1.0)
                      .set(P::eccentricity_amplitude, a)
                      .set(P::eccentricity_period, period)
                      .set(P::eccentricity_phase, 0.3),
                  0);
  double most = 0, mean = 0;
  for (int i = 0; i < 1000; ++i) {
    const double y = period * i / 1000;
    const double off = encoder.read(y, 0, 1e-3) - y;
    EXPECT_NEAR(encoder.read(y + 3 * period, 0, 1e-3) - encoder.read(y, 0, 1e-3), 3 * period, 1e-15);
    most = std::max(most, std::abs(off));
    mean += off / 1000;
  }
  EXPECT_NEAR(most, a, 1e-8);
  EXPECT_NEAR(mean, 0, 1e-15);
}

TEST(EncoderMissedCounts, LosesBurstsAtItsRateOnlyWhileFast) {
  const double q = 1e-5, rate = 5;
  Model model = Model(1.0).set(P::missed_burst, 4).set(P::missed_rate, rate).set(P::missed_speed, 0.2);
  Encoder encoder(model, q, 7);
  for (int tick = 0; tick < 100000; ++tick) encoder.read(0, 0.19, 1e-3);
  EXPECT_EQ(encoder.offset_m(), 0.0);
  const double seconds = 400;
  for (int tick = 0; tick < seconds * 1000; ++tick) encoder.read(0, 0.3, 1e-3);
  const double bursts = -encoder.offset_m() / (4 * q);
  EXPECT_NEAR(bursts, rate * seconds, 4 * std::sqrt(rate * seconds));
  EXPECT_NEAR(bursts, std::round(bursts), 1e-6);
}

TEST(EncoderMissedCounts, TheReadingJumpsBackAndStaysOff) {
  Model model = Model(1.0).set(P::missed_burst, 10).set(P::missed_rate, 1e9).set(P::missed_speed, 0.2);
  Encoder encoder(model, 1e-5);
  EXPECT_NEAR(encoder.read(0.1, 0.5, 1e-3), 0.1 - 1e-4, 1e-9);
  EXPECT_NEAR(encoder.read(0.2, 0, 1e-3), 0.2 - 1e-4, 1e-9);
  EXPECT_NEAR(encoder.read(0.1, -0.5, 1e-3), 0.1, 1e-9);  // lost the other way round
}

TEST(EncoderMissedCounts, ASeedRepeatsARecordingAndAnotherDoesNot) {
  Model model = Model(1.0).set(P::missed_burst, 4).set(P::missed_rate, 20).set(P::missed_speed, 0);
  Encoder a(model, 1e-5, 3), b(model, 1e-5, 3), c(model, 1e-5, 4);
  bool differs = false;
  for (int tick = 0; tick < 5000; ++tick) {
    const double reading = a.read(0, 0.3, 1e-3);
    ASSERT_EQ(reading, b.read(0, 0.3, 1e-3));
    differs |= reading != c.read(0, 0.3, 1e-3);
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace cartwright
