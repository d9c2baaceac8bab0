#include "host/diagnose/judge/confidence.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

Evidence clear() {
  Evidence e;
  e.gain_nats = 2000;
  return e;
}

TEST(Confidence, IsNeverCertainAndNeverNegative) {
  EXPECT_LT(confidence(clear()), 1);
  EXPECT_GT(confidence(clear()), 0.95);
  Evidence nothing;
  EXPECT_EQ(confidence(nothing), 0);
  nothing.gain_nats = -5;
  EXPECT_EQ(confidence(nothing), 0);
  Evidence all_left = clear();
  all_left.share_left = 1;
  EXPECT_EQ(confidence(all_left), 0);
}

TEST(Confidence, GrowsWithGain) {
  double before = 0;
  for (const double gain : {1.0, 12.0, 30.0, 100.0}) {
    Evidence e = clear();
    e.gain_nats = gain;
    EXPECT_GT(confidence(e), before);
    before = confidence(e);
  }
}

TEST(Confidence, OfAFurtherEffectGrowsWithItsShare) {
  Evidence little = clear(), half = clear();
  little.share_of_gain = 0.035, half.share_of_gain = 0.5;
  EXPECT_LT(confidence(little), 0.8);
  EXPECT_NEAR(confidence(half), confidence(clear()), 1e-4);
}

TEST(Confidence, GrowsWithTheMarginOverARival) {
  double before = 0;
  for (const double behind : {0.0, 2.0, 5.0, 20.0}) {
    Evidence e = clear();
    e.rivals = weight_of_rival(behind);
    EXPECT_GT(confidence(e), before);
    before = confidence(e);
  }
}

TEST(Confidence, FallsWithWhatIsLeftAndAtABound) {
  Evidence left = clear(), more = clear(), bound = clear();
  left.share_left = 0.1, more.share_left = 0.3, bound.at_bound = 1;
  EXPECT_GT(confidence(clear()), confidence(left));
  EXPECT_GT(confidence(left), confidence(more));
  EXPECT_GT(confidence(clear()), confidence(bound));
}

TEST(Confidence, IsSharedEvenlyWithARivalThatDoesAsWell) {
  Evidence tied = clear(), three = clear();
  tied.rivals = weight_of_rival(0);
  three.rivals = 2 * weight_of_rival(-3);  // chosen because it is simpler: the rival counts no more than that
  EXPECT_NEAR(confidence(tied), confidence(clear()) / 2, 1e-12);
  EXPECT_NEAR(confidence(three), confidence(clear()) / 3, 1e-12);
}

}  // namespace
}  // namespace cartwright
