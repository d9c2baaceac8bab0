#include "host/session/even_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "host/session/segments.hpp"

namespace cartwright {
namespace {

/// Rows 1 to 3 ms apart, the input held from row to row, nothing recorded between 0.9 s and 1.2 s.
Recording uneven() {
  Recording recording;
  recording.file = "uneven.csv";
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> step_s(1e-3, 3e-3);
  for (double t = 0.25; t < 2; t += step_s(random)) {
    if (t > 0.9 && t < 1.2) continue;
    recording.t_s.push_back(t);
    recording.y_m.push_back(3 - 2 * t);
    recording.u_V.push_back(std::floor(5 * std::sin(7 * t)));
    recording.other_columns["i_A"].push_back(t);
  }
  return recording;
}

double impulse(const Recording& r, double from_s, double to_s, double last_s) {
  double sum = 0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    const double until = k + 1 < r.size() ? r.t_s[k + 1] : r.t_s[k] + last_s;
    sum += r.u_V[k] * std::max(0.0, std::min(until, to_s) - std::max(r.t_s[k], from_s));
  }
  return sum;
}

TEST(EvenRows, AStraightMotionStaysOneAndTheInputPushesAsMuch) {
  const Recording before = uneven();
  const Recording after = even_rows(before, 400);
  ASSERT_GT(after.size(), 500u);
  for (std::size_t row = 0; row < after.size(); ++row) {
    EXPECT_NEAR(after.y_m[row], 3 - 2 * after.t_s[row], 1e-12);
    EXPECT_NEAR(after.other_columns.at("i_A")[row], after.t_s[row], 1e-12);
    const double ticks = (after.t_s[row] - before.t_s[0]) * 400;
    EXPECT_NEAR(ticks, std::round(ticks), 1e-6);
  }
  // Over whole new ticks of a stretch without a gap, what drives the cart is the same.
  const double from_s = after.t_s[10], to_s = after.t_s[200];
  ASSERT_LT(to_s, 0.9);
  EXPECT_NEAR(impulse(after, from_s, to_s, 1.0 / 400), impulse(before, from_s, to_s, 0), 1e-9);
}

TEST(EvenRows, AGapStaysOne) {
  const Recording before = uneven();
  const Recording after = even_rows(before, 400);
  ASSERT_EQ(row_spacing(before.t_s).gaps, 1u);
  EXPECT_FALSE(row_spacing(before.t_s).even());
  EXPECT_EQ(row_spacing(after.t_s).gaps, 1u);
  EXPECT_TRUE(row_spacing(after.t_s).even());
  for (const double t : after.t_s) EXPECT_TRUE(t < 0.903 || t > 1.2) << t;
}

TEST(EvenRows, AClockThatChangesItsRateLeavesNoGap) {
  Recording recording;
  for (double t = 0; t < 2; t += t < 1.5 ? 3.5e-3 : 5.5e-3) {
    recording.t_s.push_back(t);
    recording.y_m.push_back(t);
    recording.u_V.push_back(1);
  }
  ASSERT_GT(row_spacing(recording.t_s).gaps, 10u);
  const Recording after = even_rows(recording, 190);
  EXPECT_EQ(row_spacing(after.t_s).gaps, 0u);
  EXPECT_EQ(after.size(), static_cast<std::size_t>(recording.t_s.back() * 190) + 1);
}

}  // namespace
}  // namespace cartwright
