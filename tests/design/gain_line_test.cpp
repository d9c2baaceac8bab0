// Sec. 4.4 of Wongvanich, Hann and Sirisena: the least Kd at Kp = 100 for 1 % settling within 0.5 s.
#include "host/design/gain_line.hpp"

#include <gtest/gtest.h>

#include "tests/design/published.hpp"

namespace cartwright::design {
namespace {

Specification one_per_cent_in_half_a_second() {
  Specification s;
  s.settling_band = 0.01;
  s[Quantity::settling_time] = 0.5;
  return s;
}

TEST(LeastDerivativeGain, OfThePublishedModelsWithTheIdealLaw) {
  const Specification s = one_per_cent_in_half_a_second();
  const auto linear = least_derivative_gain(test::lm3(), Loop::continuous(), {}, s, 100, 20);
  const auto nonlinear = least_derivative_gain(test::nlm3(), Loop::continuous(), {}, s, 100, 20);
  ASSERT_TRUE(linear && nonlinear);
  EXPECT_NEAR(*linear, 6.3, 0.1);
  EXPECT_NEAR(*nonlinear, 3.8, 0.1);
}

TEST(DerivativeGains, ThatMeetASpecificationAreTwoIntervalsForTheNonlinearModel) {
  const auto found = derivative_gains(test::nlm3(), Loop::continuous(), {}, one_per_cent_in_half_a_second(),
                                      {.kp_V_per_m = 100}, 0, 20);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].low, 3.8, 0.1);
  EXPECT_NEAR(found[0].high, 4.75, 0.1);
  EXPECT_NEAR(found[1].low, 7.5, 0.15);
}

TEST(YesIntervals, FindsEveryIntervalAndItsEdges) {
  const auto found = yes_intervals([](double x) { return (x >= 0.2 && x <= 0.31) || x >= 0.5; }, 0, 1, 51);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].low, 0.2, 1e-4);
  EXPECT_NEAR(found[0].high, 0.31, 1e-4);
  EXPECT_NEAR(found[1].low, 0.5, 1e-4);
  EXPECT_EQ(found[1].high, 1);
  EXPECT_TRUE(yes_intervals([](double) { return false; }, 0, 1, 11).empty());
}

}  // namespace
}  // namespace cartwright::design
