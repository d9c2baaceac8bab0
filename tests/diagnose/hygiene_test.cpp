#include "host/diagnose/judge/hygiene.hpp"

#include <gmock/gmock.h>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;

TEST(Hygiene, HasNothingToSayOfAGoodSession) {
  const auto remarks = check_hygiene(test::battery({}));
  ASSERT_TRUE(remarks);
  EXPECT_TRUE(remarks->empty());
}

TEST(Hygiene, RefusesASessionInWhichNothingMoves) {
  Session session = test::battery({});
  for (Recording& r : session.recordings) std::fill(r.y_m.begin(), r.y_m.end(), 0.1);
  const auto remarks = check_hygiene(session);
  ASSERT_FALSE(remarks);
  EXPECT_THAT(remarks.error().message, HasSubstr("never moves"));
}

TEST(Hygiene, NamesTheOneRecordingThatShowsNothing) {
  Session session = test::battery({});
  Recording& still = session.recordings[2];
  std::fill(still.y_m.begin(), still.y_m.end(), 0.1);
  Recording& limited = session.recordings[3];
  std::fill(limited.u_V.begin(), limited.u_V.end(), session.rig.voltage_limit_V);
  const auto remarks = check_hygiene(session);
  ASSERT_TRUE(remarks);
  EXPECT_THAT(*remarks, testing::ElementsAre(HasSubstr(still.file), HasSubstr(limited.file)));
}

TEST(Hygiene, RefusesARateThatTheRowsContradict) {
  Session session = test::battery({});
  session.rig.sample_rate_hz = 500;
  const auto remarks = check_hygiene(session);
  ASSERT_FALSE(remarks);
  EXPECT_THAT(remarks.error().message, HasSubstr("sample_rate_hz = 500"));
}

}  // namespace
}  // namespace cartwright
