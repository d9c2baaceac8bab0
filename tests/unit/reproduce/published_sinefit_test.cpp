#include "host/reproduce/published_sinefit.hpp"

#include <gmock/gmock.h>

#include "host/relay/sinefit.hpp"
#include "host/reproduce/sinefit_examples.hpp"
#include "tests/unit/relay/sine_signals.hpp"

namespace cartwright::reproduce {
namespace {

TEST(PublishedSineFit, FindsACleanSineWhoseStartIsInTheMainLobe) {
  std::mt19937_64 random(1);
  const auto data = test::SineSignal{.amplitude = 2, .frequency_hz = 2, .phase_rad = 1.2}.draw(random);
  const auto fit = published_sinefit(data.t_s, data.y, 2.05);
  EXPECT_NEAR(fit.frequency_hz, 2, 1e-5);
  EXPECT_NEAR(fit.amplitude, 2, 1e-4);
  EXPECT_NEAR(fit.phase_rad, 1.2, 1e-3);
}

TEST(PublishedSineFit, LandsOnSideLobesOfALongRecordWhereTheSpectrumDoesNot) {
  std::mt19937_64 random(2);
  int published = 0, ours = 0;
  constexpr int kDraws = 100;
  for (int i = 0; i < kDraws; ++i) {
    test::SineSignal s{.amplitude = 2, .frequency_hz = 25, .phase_rad = 0.06 * i, .noise = 1};
    const auto data = s.draw(random);
    const double lobe_hz = 1 / (data.t_s.back() - data.t_s.front());
    published += std::abs(published_sinefit(data.t_s, data.y, 1.25 * 25).frequency_hz - 25) > lobe_hz;
    const auto fit = sinefit(data.t_s, data.y);
    ours += !fit || std::abs(fit->frequency_hz.value - 25) > lobe_hz;
  }
  EXPECT_GT(published, kDraws / 2);
  EXPECT_EQ(ours, 0);
}

TEST(BrentMinimum, FindsTheVertexOfAParabolaAndALocalMinimumOfAWave) {
  EXPECT_NEAR(brent_minimum([](double x) { return (x - 1.7) * (x - 1.7); }, 0, 5, 1e-8), 1.7, 1e-6);
  const double x = brent_minimum([](double z) { return std::cos(z) + 0.01 * z; }, 0, 30, 1e-8);
  EXPECT_NEAR(std::sin(x), 0.01, 1e-6);  // slope zero
  EXPECT_LT(std::cos(x), 0);             // and a valley
}

TEST(Reproduction, TheRelayRecordLosesByAWrongFrequencyAsPublished) {
  const auto section = relay_record_example({});
  ASSERT_TRUE(section) << section.error().message;
  ASSERT_EQ(section->items.size(), 1U);
  EXPECT_GT(std::stod(section->items[0].obtained), 1.5);
}

}  // namespace
}  // namespace cartwright::reproduce
