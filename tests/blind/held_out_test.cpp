#include <gmock/gmock.h>

#include "host/diagnose/diagnosis.hpp"
#include "tests/blind/outcome.hpp"

namespace cartwright::blind {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A recording is used instead of held out where it alone shows a push. What an amplifier without a name does
/// looks like pushes in all of them.
TEST(HeldOut, KeepsARecordingThatIsLikeTheOthers) {
  const Question question = question_of({{"x_compression"}, Size::medium, 20102});
  const Diagnosis d = diagnose(question.session, question.nominal);
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_EQ(d.held_out_recordings.size(), 1u);
  EXPECT_THAT(d.remarks, Not(Contains(HasSubstr("something of its own"))));
}

}  // namespace
}  // namespace cartwright::blind
