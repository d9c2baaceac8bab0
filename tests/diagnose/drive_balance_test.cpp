// What the drive tells where a servo holds the speed. The drives are made of formulas, not by simulating a
// servo.

#include "host/diagnose/drive/drive_balance.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "host/diagnose/judge/name_from_drive.hpp"

namespace cartwright {
namespace {

using P = Parameter;
constexpr double kTurn = 2 * std::numbers::pi;

/// What the drive balances at a place and a time [V].
using Balanced = std::function<double(double y_m, double t_s)>;

constexpr double kFriction_V = 0.3;

/// A metre of way, once at each of the speeds, which wander by some tenths; a drive with friction, coloured
/// noise of 0.1 V and what it balances.
Session held_speeds(const Balanced& balanced, std::vector<double> speeds_m_per_s, unsigned seed) {
  constexpr double kTick_s = 2e-3, kCount_m = 1e-4;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Session session;
  session.rig = {"rotor"};
  session.rig.sample_rate_hz = 1 / kTick_s;
  session.rig.encoder_resolution_m = kCount_m;
  for (const double speed : speeds_m_per_s) {
    Recording r;
    r.file = "held_" + std::to_string(session.recordings.size()) + ".csv";
    double y = 0.01 * normal(random), wander = 0, noise = 0;
    for (int k = 0; k * kTick_s * speed < 1; ++k) {
      const double t = k * kTick_s;
      wander += -wander * kTick_s / 0.1 + 0.06 * std::sqrt(kTick_s) * normal(random);
      noise += -noise * kTick_s / 0.05 + 0.1 * std::sqrt(2 * kTick_s / 0.05) * normal(random);
      y += kTick_s * speed * (1 + 0.3 * std::tanh(10 * wander));
      r.t_s.push_back(t);
      r.y_m.push_back(kCount_m * std::round(y / kCount_m));
      r.u_V.push_back(kFriction_V + noise + balanced(y, t));
    }
    session.recordings.push_back(std::move(r));
  }
  return session;
}

const std::vector<double> kTwoSpeeds{0.1, 0.05};
constexpr unsigned kDraws = 20;

double cogs(double y_m) {
  return 0.5 * std::sin(kTurn * 7 * y_m + 1) + 0.3 * std::sin(kTurn * 28 * y_m) +
         0.2 * std::sin(kTurn * 14 * y_m - 2);
}

TEST(DriveBalance, FindsTheLinesOfTheWayWithTheirIntervals) {
  const std::vector<std::pair<double, double>> lines{{7, 0.5}, {28, 0.3}, {14, 0.2}};  // per m, V
  std::vector<unsigned> period_inside(3), height_inside(3);
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    const auto found =
        drive_balance(held_speeds([](double y, double) { return cogs(y); }, kTwoSpeeds, seed), 2);
    ASSERT_TRUE(found);
    ASSERT_GE(found->held, 3U);
    EXPECT_LT(found->share_left(), 0.2);
    EXPECT_TRUE(names_cogging(*found));
    EXPECT_NEAR(found->friction_V, kFriction_V, 0.1);
    for (std::size_t i = 0; i < 3; ++i) {
      const DriveLine& line = found->lines[i];
      period_inside[i] += line.period_m.low < 1 / lines[i].first && 1 / lines[i].first < line.period_m.high;
      height_inside[i] += line.height_V.low < lines[i].second && lines[i].second < line.height_V.high;
    }
  }
  // 20 draws of a 95 % interval: fewer than 16 inside has a probability below 0.3 %.
  EXPECT_THAT(period_inside, testing::Each(testing::Ge(16U)));
  EXPECT_THAT(height_inside, testing::Each(testing::Ge(16U)));
}

TEST(DriveBalance, FindsNoLineWhereTheDriveBalancesFrictionOnly) {
  for (unsigned seed = 1; seed <= kDraws; ++seed)
    EXPECT_FALSE(drive_balance(held_speeds([](double, double) { return 0.0; }, kTwoSpeeds, seed), 2));
}

/// The same in every recording, as cogging is, but no period: what three quarters of the way show does not
/// tell the fourth.
TEST(DriveBalance, DoesNotCallARoughRailCogging) {
  unsigned named = 0;
  for (unsigned seed = 1; seed <= kDraws; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::pair<double, double>> bumps;  // place, height
    for (int i = 0; i < 60; ++i) bumps.emplace_back(i / 60.0, 0.3 * normal(random));
    const auto rough = [&](double y, double) {
      double sum = 0;
      for (const auto& [place, height] : bumps)
        sum += height * std::exp(-0.5 * std::pow((y - place) / 0.02, 2));
      return sum;
    };
    const auto found = drive_balance(held_speeds(rough, kTwoSpeeds, seed), 2);
    named += found && names_cogging(*found);
  }
  EXPECT_LE(named, 1U);
}

TEST(DriveBalance, TellsWhatRepeatsInTimeFromTheWayAtTwoSpeedsOnly) {
  const auto ripple = [](double, double t) { return 0.4 * std::sin(kTurn * 0.9 * t); };
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto two = drive_balance(held_speeds(ripple, kTwoSpeeds, seed), 2);
    EXPECT_FALSE(two && names_cogging(*two));
    const auto one = drive_balance(held_speeds(ripple, {0.1}, seed), 2);
    if (!one) continue;
    Diagnosis d;
    name_from_drive(*one, Model(2.0), d);
    EXPECT_LE(d.effects.front().confidence, 0.5);
    EXPECT_THAT(statement_of_drive(*one), testing::HasSubstr("a second speed would tell"));
  }
}

/// The model's push is what the drive balances, against it.
TEST(DriveBalance, NamesCoggingWithTheGainAsGiven) {
  const auto found = drive_balance(held_speeds([](double y, double) { return cogs(y); }, kTwoSpeeds, 1), 2);
  ASSERT_TRUE(found);
  const Model nominal = Model(2.0).set(P::coulomb_level, 0.1);
  Diagnosis d;
  d.parameters = {{P::voltage_gain, 2.0, {1.7, 1.6, 1.8}, 1.7}};
  name_from_drive(*found, nominal, d);
  EXPECT_EQ(d.verdict, Verdict::missing_physics);
  ASSERT_EQ(d.effects.size(), 1U);
  EXPECT_EQ(d.effects[0].term, Term::cogging);
  EXPECT_GT(d.effects[0].confidence, 0.7);
  EXPECT_EQ(d.parameters[0].refitted.value, 2.0);
  EXPECT_FALSE(d.parameters[0].refitted.has_interval());
  EXPECT_NEAR(d.model[P::coulomb_level], 2.0 * found->friction_V, 1e-12);
  for (double y = 0; y < 1; y += 0.01) {
    double push = 0;
    for (const PeriodicTerm& wave : kCoggingWaves)
      push += d.model[wave.amplitude] * std::sin(kTurn * y / d.model[wave.period] + d.model[wave.phase]);
    EXPECT_NEAR(push, -2.0 * cogs(y), 0.25) << y;
  }
}

/// A cart that stands is held by friction whatever the drive; one that is thrown holds no speed.
TEST(DriveWindows, LeaveOutWhatStandsAndWhatIsThrown) {
  Session session = held_speeds([](double, double) { return 0.0; }, {0.1}, 1);
  const std::size_t all = drive_windows(session).size();
  Recording& r = session.recordings.front();
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (r.t_s[k] > 5) r.y_m[k] += 0.05;                        // thrown within one tick
    if (r.t_s[k] > 2 && r.t_s[k] < 3) r.y_m[k] = r.y_m[1000];  // stands for a second, then jumps on
  }
  const std::vector<DriveWindow> kept = drive_windows(session);
  EXPECT_LT(kept.size(), all - 20);
  for (const DriveWindow& w : kept) {
    const double from = r.t_s[w.first], to = r.t_s[w.last];
    EXPECT_FALSE(from < 3 && to > 2) << from;
    EXPECT_FALSE(from <= 5 && to > 5.01) << from;
  }
}

}  // namespace
}  // namespace cartwright
