#include "host/diagnose/judge/told_apart.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

/// A term that falls `behind` in 100 blocks alike, but for chance of a hundredth of the noise.
Explanation behind_by(double behind_nats) {
  Explanation one;
  one.effects = {Term::constant_force};
  one.fit.error_rms_m = 1;
  one.fit.log_likelihood = -behind_nats;
  one.fit.blocks = {100};
  for (int block = 0; block < 100; ++block)
    one.fit.block_loss_m2.push_back(1 + 0.02 * behind_nats + (block % 2 == 0 ? 0.01 : -0.01) * behind_nats);
  return one;
}

Contest contest_that_gained(double gain_nats) {
  const Explanation winner = behind_by(0);
  return {Term::asymmetric_viscous_friction, gain_nats, winner.score() - gain_nats, winner, {}, {}};
}

TEST(ToldApart, WhatIsFarBehindIsWhereAllIsExplained) {
  EXPECT_TRUE(told_apart(contest_that_gained(800), behind_by(300), 0, kLeastGain));
}

TEST(ToldApart, WhatIsWithinChanceIsNot) {
  Explanation other = behind_by(0);
  other.fit.block_loss_m2.front() += 2;   // a nat in one block ...
  other.fit.block_loss_m2.back() -= 1.5;  // ... and the other way in another
  other.fit.log_likelihood = -0.25;
  EXPECT_FALSE(told_apart(contest_that_gained(800), other, 0, kLeastGain));
}

TEST(ToldApart, LittleBehindButInEveryBlockIs) {
  EXPECT_TRUE(told_apart(contest_that_gained(800), behind_by(9), 0, kLeastGain));
}

TEST(ToldApart, WhatIsLeftMayBeAllOfASmallDifferenceToo) {
  EXPECT_FALSE(told_apart(contest_that_gained(800), behind_by(9), 300, kLeastGain));
}

TEST(ToldApart, WhatIsLeftMayBeAllOfTheDifference) {
  EXPECT_FALSE(told_apart(contest_that_gained(800), behind_by(300), 301, kLeastGain));
  EXPECT_TRUE(told_apart(contest_that_gained(800), behind_by(300), 299, kLeastGain));
}

TEST(ToldApart, WhatGainsTooLittleForANameIsWhateverIsLeft) {
  EXPECT_FALSE(told_apart(contest_that_gained(300), behind_by(280), 1000, kLeastGain));
  EXPECT_TRUE(told_apart(contest_that_gained(300), behind_by(280), 1000, 2 * kLeastGain));
  EXPECT_TRUE(told_apart(contest_that_gained(300), behind_by(295), 1000, kLeastGain));
}

}  // namespace
}  // namespace cartwright
