#include "host/diagnose/judge/predicts_no_better.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/diagnose/judge/prediction_errors.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using P = Parameter;

/// An answer that names something and lowers the window errors.
Diagnosis answer() {
  Diagnosis d;
  d.search.contests.resize(1);
  d.used = {3e-4, 2e-4, 5e-5};
  d.uniform_motion_m = 2e-2;
  return d;
}

Model exact() {
  return Model(1.9).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.4);
}

Model off_by(double factor) {
  return exact().set(P::voltage_gain, 1.9 * factor);
}

/// Two tracks of that cart, predicted by a nominal model and by a found one.
WindowErrors tracks(const Model& nominal, const Model& found) {
  Session session = test::battery({});
  session.recordings = {session.recordings[3], session.recordings[7]};
  return {window_errors(nominal, session, 1), window_errors(found, session, 1)};
}

TEST(PredictsNoBetter, IsSilentWhereTheAnswerPredictsBetter) {
  const WindowErrors windows = tracks(off_by(1.02), exact());
  EXPECT_THAT(predicts_no_better(answer(), windows, windows), IsEmpty());
}

TEST(PredictsNoBetter, SaysThatTheNominalModelPredictsUnseenRecordingsBetter) {
  const WindowErrors good = tracks(off_by(1.02), exact()), bad = tracks(off_by(1.02), off_by(1.1));
  EXPECT_THAT(predicts_no_better(answer(), good, bad), HasSubstr("held-out"));
}

TEST(PredictsNoBetter, AsksTheRecordingsThatWereUsedToo) {
  EXPECT_THAT(predicts_no_better(answer(), tracks(off_by(1.02), off_by(1.1)), {}),
              HasSubstr("nominal model"));
}

TEST(PredictsNoBetter, LeavesALittleWorseAlone) {
  const WindowErrors windows = tracks(off_by(1.02), off_by(1.024));
  EXPECT_THAT(predicts_no_better(answer(), windows, windows), IsEmpty());
}

TEST(PredictsNoBetter, DoesNotJudgeByTwoWindows) {
  WindowErrors few = tracks(off_by(1.02), off_by(1.1));
  few.nominal.resize(2);
  few.with_effects.resize(2);
  EXPECT_THAT(predicts_no_better(answer(), few, {}), IsEmpty());
}

TEST(PredictsNoBetter, SaysThatACartWithoutForcesPredictsBetter) {
  const WindowErrors windows = tracks(off_by(1.02), exact());
  Diagnosis d = answer();
  d.uniform_motion_m = 4e-5;
  EXPECT_THAT(predicts_no_better(d, windows, windows), HasSubstr("keeps its speed"));
}

}  // namespace
}  // namespace cartwright
