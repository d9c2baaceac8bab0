#include "host/diagnose/judge/adequacy.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

/// An effect that so many of three recordings show.
Support shown_by(int recordings) {
  Support support;
  for (int r = 0; r < 3; ++r) support.recordings.push_back({"r.csv", r < recordings ? 100.0 : 1.0, 10});
  return support;
}

TEST(Adequacy, LeavesAFifthOfTheWindowsAndTwoFifthsOfTheLikelihood) {
  EXPECT_FALSE(too_much_left(0.1, 0.3, {shown_by(1), shown_by(3)}));
  EXPECT_TRUE(too_much_left(0.3, 0.3, {shown_by(3)}));
  EXPECT_TRUE(too_much_left(0.1, 0.5, {shown_by(3)}));
}

TEST(Adequacy, OfOneEffectThatMostRecordingsShowTheFormMayDiffer) {
  EXPECT_FALSE(too_much_left(0.03, 0.5, {shown_by(2)}));
  EXPECT_TRUE(too_much_left(0.03, 0.5, {shown_by(1)}));
  EXPECT_TRUE(too_much_left(0.03, 0.5, {shown_by(3), shown_by(3)})) << "two may make up for a third";
}

TEST(Adequacy, ExcessIsAboveTheFloor) {
  EXPECT_DOUBLE_EQ(excess_left({9, 5, 3}, 1), (9.0 - 1) / (25 - 1));
  EXPECT_DOUBLE_EQ(excess_left({1, 1, 1}, 1), 1) << "none there to be explained";
}

}  // namespace
}  // namespace cartwright
