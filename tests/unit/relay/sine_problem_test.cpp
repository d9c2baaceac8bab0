#include "host/relay/sine_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace cartwright {
namespace {

TEST(CosineAndSineOfCycles, AreWithinRoundingOfTheLibrarys) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> one_turn(-0.5, 0.5);
  std::vector<double> cycles{0, 0.25, 0.5, -0.5, -0.25, 0.125, 0.499999999};
  while (cycles.size() < 100003) cycles.push_back(one_turn(random));
  std::vector<double> cosine(cycles.size()), sine(cycles.size());
  cosine_and_sine_of_cycles(cycles.data(), cycles.size(), cosine.data(), sine.data());
  double worst = 0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(cycles[i]);
    worst = std::max({worst, std::abs(cosine[i] - static_cast<double>(std::cos(angle))),
                      std::abs(sine[i] - static_cast<double>(std::sin(angle)))});
  }
  EXPECT_LT(worst, 1.5e-15);
}

TEST(CosineAndSineOfCycles, WholeTurnsChangeNothing) {
  std::vector<double> near, far;
  for (int i = 0; i < 64; ++i) {
    near.push_back((i - 32) / 64.0);
    far.push_back(near.back() + (i % 2 == 0 ? 1 : -1) * 1024.0 * i);
  }
  std::vector<double> c(64), s(64), c_far(64), s_far(64);
  cosine_and_sine_of_cycles(near.data(), 64, c.data(), s.data());
  cosine_and_sine_of_cycles(far.data(), 64, c_far.data(), s_far.data());
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(c[i], c_far[i]) << near[i];
    EXPECT_NEAR(s[i], s_far[i], 1e-15) << near[i];  // half a turn may round to either side
  }
}

}  // namespace
}  // namespace cartwright
