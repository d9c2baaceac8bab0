#include "host/session/join.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cartwright {
namespace {

Session session_of(std::initializer_list<const char*> files, double first_m) {
  Session session;
  session.rig.sample_rate_hz = 50;
  session.rig.voltage_limit_V = 5;
  session.rig.travel_m = {first_m, first_m + 0.2};
  for (const char* file : files) {
    Recording& one = session.recordings.emplace_back();
    one.file = file;
    one.t_s = {0, 0.02};
    one.y_m = {first_m, first_m};
    one.u_V = {0, 0};
  }
  return session;
}

TEST(Join, AddsWhatIsNewAndReplacesWhatIsOfTheSameFile) {
  const auto whole = joined(session_of({"a.csv", "b.csv"}, -0.1), session_of({"b.csv", "c.csv"}, 0.0));
  ASSERT_TRUE(whole) << whole.error().message;
  ASSERT_EQ(whole->recordings.size(), 3u);
  EXPECT_EQ(whole->recordings[0].file, "a.csv");
  EXPECT_EQ(whole->recordings[1].file, "b.csv");
  EXPECT_EQ(whole->recordings[1].y_m[0], 0.0) << "the later one";
  EXPECT_EQ(whole->recordings[2].file, "c.csv");
  EXPECT_EQ(whole->rig.travel_m, (std::array<double, 2>{-0.1, 0.2}));
}

TEST(Join, RefusesAnotherRig) {
  Session faster = session_of({"c.csv"}, 0);
  faster.rig.sample_rate_hz = 500;
  const auto rates = joined(session_of({"a.csv"}, 0), faster);
  ASSERT_FALSE(rates);
  EXPECT_THAT(rates.error().message, testing::HasSubstr("one sample rate"));

  Session finer = session_of({"c.csv"}, 0);
  finer.rig.encoder_resolution_m = 1e-6;
  const auto encoders = joined(session_of({"a.csv"}, 0), finer);
  ASSERT_FALSE(encoders);
  EXPECT_THAT(encoders.error().message, testing::HasSubstr("encoder"));
}

}  // namespace
}  // namespace cartwright
