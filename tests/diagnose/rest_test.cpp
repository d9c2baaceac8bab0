#include "host/diagnose/observe/rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/diagnose/diagnosis.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

constexpr double kRestCount_m = 1e-4;
constexpr double kAmplitude_m = 0.05, kRadians_per_s = 6.3;
/// 5 sqrt(2 q / a), where v is the greatest speed of a sine and L its travel.
const double kReach_s =
    5 * std::sqrt(2 * kRestCount_m * 2 * 2 * kAmplitude_m / std::pow(kRadians_per_s * kAmplitude_m, 2));

/// Two seconds of readings, in counts.
Recording readings(const std::function<double(double t_s)>& counts) {
  Recording r;
  for (int k = 0; k < 2000; ++k) {
    r.t_s.push_back(k * Rig().period_s());
    r.y_m.push_back(kRestCount_m * std::round(counts(r.t_s.back())));
  }
  return r;
}

/// Beside a sine, which says how fast the cart is.
Session beside_a_sine(const Recording& r) {
  Session session;
  session.rig.encoder_resolution_m = kRestCount_m;
  session.recordings = {
      r, readings([](double t) { return kAmplitude_m / kRestCount_m * std::sin(kRadians_per_s * t); })};
  return session;
}

std::vector<bool> rests_of(const Recording& r) {
  const Session session = beside_a_sine(r);
  return rows_at_rest(session, time_at_rest_s(session)).front();
}

std::size_t resting(const Recording& r) {
  const std::vector<bool> rests = rests_of(r);
  return static_cast<std::size_t>(std::count(rests.begin(), rests.end(), true));
}

TEST(Rest, ACartThatMovesNeverRestsAndOneThatStandsAlwaysDoes) {
  EXPECT_EQ(resting(readings([](double t) { return 100 * t; })), 0u);
  EXPECT_EQ(resting(readings([](double) { return 7; })), 2000u);
  // A reading between two counts flickers.
  EXPECT_EQ(resting(readings([](double t) { return std::fmod(t, 0.002) < 0.001 ? 7 : 8; })), 2000u);
}

TEST(Rest, BeginsSomeTimeAfterAMoveAndEndsAsLongBeforeTheNext) {
  const Recording r = readings([](double t) {
    return t < 0.5 ? 400 * t : t < 1.5 ? 200 : 200 + 400 * (t - 1.5);
  });
  const std::vector<bool> rests = rests_of(r);
  for (std::size_t k = 0; k < r.size(); ++k) {
    const double t = r.t_s[k];
    if (t < 0.49 + kReach_s || t > 1.51 - kReach_s) {
      EXPECT_FALSE(rests[k]) << t;
    } else if (t > 0.51 + kReach_s && t < 1.49 - kReach_s) {
      EXPECT_TRUE(rests[k]) << t;
    }
  }
}

/// Of a cart that creeps readings before a count changes and after it must be left out alike: the first are
/// all behind it, the second all ahead.
TEST(Rest, IsTheSameBackwards) {
  Recording r = readings([](double t) { return 3 + 6 * t * t; });
  const std::vector<bool> forwards = rests_of(r);
  std::reverse(r.y_m.begin(), r.y_m.end());
  std::vector<bool> backwards = rests_of(r);
  std::reverse(backwards.begin(), backwards.end());
  EXPECT_EQ(forwards, backwards);
  EXPECT_GT(std::count(forwards.begin(), forwards.end(), true), 0);
}

TEST(Rest, IsTheSameInOtherUnitsOfLength) {
  Session session = beside_a_sine(readings([](double t) { return 3 + 6 * t * t; }));
  const std::vector<std::vector<bool>> in_metres = rows_at_rest(session, time_at_rest_s(session));
  session.rig.encoder_resolution_m *= 1000;
  for (Recording& r : session.recordings) {
    for (double& y : r.y_m) y *= 1000;
  }
  EXPECT_EQ(rows_at_rest(session, time_at_rest_s(session)), in_metres);
}

TEST(Rest, IsNotToldWithoutACount) {
  Session session = beside_a_sine(readings([](double) { return 7; }));
  session.rig.encoder_resolution_m = 0;
  EXPECT_EQ(time_at_rest_s(session), 0);
  for (const std::vector<bool>& rests : rows_at_rest(session, 0))
    EXPECT_EQ(std::count(rests.begin(), rests.end(), true), 0);
}

/// Noise that is fitted to a cart at rest as well is too small for the cart that moves, whose errors then
/// have colour: they gain half as much again along the axes as chance does.
TEST(Rest, LeavesErrorsOfMovesWithoutColour) {
  double gained = 0, chance = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::IndependentCart cart;
    cart.reading_noise_counts = 0, cart.seed = seed;
    const Diagnosis d = diagnose(test::moves(cart), test::nominal(1.9, 5, 0.4));
    for (const AxisMap& axis : d.before.axes) gained += axis.gain, chance += axis.mean();
  }
  EXPECT_LT(gained, 1.3 * chance);
}

}  // namespace
}  // namespace cartwright
