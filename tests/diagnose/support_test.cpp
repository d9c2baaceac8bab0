#include "host/diagnose/judge/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using P = Parameter;

Support said(const std::vector<std::pair<double, double>>& nats_and_errors) {
  Support support;
  for (const auto& [nats, error] : nats_and_errors) support.recordings.push_back({"r.csv", nats, error});
  return support;
}

TEST(Contradiction, IsNoneWhereChanceWouldSayAsMuch) {
  EXPECT_EQ(contradiction(said({{500, 100}, {400, 100}, {-40, 20}}), 12), nullptr);
  EXPECT_EQ(contradiction({}, 12), nullptr);
}

TEST(Contradiction, IsARecordingThatIsToldWorseBeyondChance) {
  const Support support = said({{500, 100}, {-40, 10}, {400, 100}});
  EXPECT_EQ(contradiction(support, 12), &support.recordings[1]);
}

TEST(Contradiction, IsNoneWhereItIsNoMoreThanAnotherLawWouldCost) {
  EXPECT_EQ(contradiction(said({{5000, 100}, {-40, 10}}), 12), nullptr)
      << "less than 3 % of what speaks for it";
  EXPECT_EQ(contradiction(said({{200, 50}, {-10, 1}}), 12), nullptr) << "less than an effect must gain";
}

TEST(Support, SaysHowManyRecordingsAndWhatTheWindowsOwe) {
  Support support = said({{500, 100}, {30, 20}, {400, 100}});
  support.windows_without_m = 5e-5;
  support.windows_with_m = 3e-5;
  EXPECT_EQ(support.recordings_for(), 2U);
  EXPECT_TRUE(support.most_say_so());
  EXPECT_DOUBLE_EQ(support.windows_moved_m(), 4e-5);
}

/// A push that was fitted to a session, with and without it.
struct Pushed {
  explicit Pushed(const std::vector<double>& pushes_m_per_s2) {
    for (const double push : pushes_m_per_s2) {
      test::IndependentCart cart;
      cart.push = [push](double, double, double) { return push; };
      const Session one = test::battery(cart);
      session.rig = one.rig;
      session.recordings.push_back(one.recordings[5]);
      session.recordings.back().file = one.recordings[5].file + std::to_string(session.recordings.size());
    }
    options = options_for(session, test::nominal());
    const Model without = test::nominal(), with = test::nominal().set(P::constant_acceleration, 0.1);
    search.best = {{Term::constant_force}, fitted(with), {}};
    search.contests.push_back({Term::constant_force, 100, 0, search.best, {}, {{}, fitted(without), {}}});
  }

  Support support() const {
    const std::vector<SquaredError> windows = window_errors(search.best.fit.model, session, 1);
    return support_of_effects(session, search, windows, options).front();
  }

  Fit fitted(const Model& start) const {
    return fit(session, start, {}, free_parameters(start, facts_of(session)), options);
  }

  Session session;
  FitOptions options;
  Search search;
};

TEST(Support, ComesFromEveryRecordingOfACartThatHasTheEffect) {
  const Pushed tilted({0.2, 0.2, 0.2});
  const Support support = tilted.support();
  ASSERT_EQ(support.recordings.size(), 3U);
  EXPECT_EQ(support.recordings_for(), 3U);
  EXPECT_GT(support.windows_without_m, 2 * support.windows_with_m);
  EXPECT_FALSE(support.windows_get_worse);
  EXPECT_THAT(unsupported(tilted.search.contests, {support}, kLeastGain), IsEmpty());
}

TEST(Support, IsRefusedByTheRecordingOfAnotherCart) {
  const Pushed mixed({0.2, 0.2, -0.1});
  const Support support = mixed.support();
  const RecordingSays* against = contradiction(support, kLeastGain);
  ASSERT_NE(against, nullptr);
  EXPECT_EQ(against->file, mixed.session.recordings[2].file);
  EXPECT_THAT(unsupported(mixed.search.contests, {support}, kLeastGain),
              HasSubstr(mixed.session.recordings[2].file + " is told worse than without constant_force"));
}

TEST(Support, IsRefusedWhereWindowsGetWorse) {
  Pushed tilted({0.2, 0.2});
  Model off = tilted.search.best.fit.model;
  tilted.search.best.fit.model = off.set(P::constant_acceleration, 0.5);
  const Support support = tilted.support();
  EXPECT_TRUE(support.windows_get_worse);
  Support windows_only = support;
  windows_only.recordings.clear();
  EXPECT_THAT(unsupported(tilted.search.contests, {windows_only}, kLeastGain), HasSubstr("windows"));
}

}  // namespace
}  // namespace cartwright
