#include "host/diagnose/predicts_no_better.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/diagnose/prediction_errors.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using P = Parameter;

/// An answer that names something, predicts the unseen recordings by `found`, and lowers the window error.
Diagnosis answer(const Model& found) {
  Diagnosis d;
  d.search.contests.resize(1);
  d.search.best.fit.model = found;
  d.used.nominal = 3e-4, d.used.refitted = 2e-4, d.used.with_effects = 5e-5;
  d.uniform_motion_m = 2e-2;
  return d;
}

Model cart() {
  return Model(1.9).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.4);
}

Model off_by(double factor) {
  return cart().set(P::voltage_gain, 1.9 * factor);
}

/// Two tracks of that cart.
Session unseen() {
  Session session = test::battery({});
  session.recordings = {session.recordings[3], session.recordings[7]};
  return session;
}

TEST(PredictsNoBetter, IsSilentWhereTheAnswerPredictsBetter) {
  EXPECT_THAT(predicts_no_better(answer(cart()), off_by(1.02), {}, unseen(), 1), IsEmpty());
}

TEST(PredictsNoBetter, SaysThatTheNominalModelPredictsUnseenRecordingsBetter) {
  EXPECT_THAT(predicts_no_better(answer(off_by(1.1)), off_by(1.02), {}, unseen(), 1),
              HasSubstr("nominal model"));
}

TEST(PredictsNoBetter, AsksTheRecordingsThatWereUsedToo) {
  EXPECT_THAT(predicts_no_better(answer(off_by(1.1)), off_by(1.02), unseen(), {}, 1),
              HasSubstr("nominal model"));
}

TEST(PredictsNoBetter, LeavesALittleWorseAlone) {
  EXPECT_THAT(predicts_no_better(answer(off_by(1.024)), off_by(1.02), {}, unseen(), 1), IsEmpty());
}

TEST(PredictsNoBetter, DoesNotJudgeByTwoWindows) {
  Session few = unseen();
  few.recordings.resize(1);
  Recording& r = few.recordings.front();
  const std::size_t second = static_cast<std::size_t>(few.rig.sample_rate_hz);
  for (auto* column : {&r.t_s, &r.u_V, &r.y_m, &r.r_m}) column->resize(second);
  EXPECT_EQ(window_mse_m2(cart(), few, 1).size(), 2U);
  EXPECT_THAT(predicts_no_better(answer(off_by(1.1)), off_by(1.02), {}, few, 1), IsEmpty());
}

TEST(PredictsNoBetter, SaysThatACartWithoutForcesPredictsBetter) {
  Diagnosis d = answer(cart());
  d.uniform_motion_m = 4e-5;
  EXPECT_THAT(predicts_no_better(d, off_by(1.02), {}, unseen(), 1), HasSubstr("keeps its speed"));
}

}  // namespace
}  // namespace cartwright
