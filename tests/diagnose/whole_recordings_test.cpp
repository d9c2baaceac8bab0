#include "host/diagnose/judge/whole_recordings.hpp"

#include <gtest/gtest.h>

#include "host/diagnose/judge/estimate.hpp"
#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/evaluate/replay.hpp"
#include "host/identify/identify.hpp"
#include "host/identify/simulation_fit.hpp"
#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

using P = Parameter;

double open_loop_m(const Model& model, const Session& session) {
  SquaredError error;
  for (const Recording& r : session.recordings) error.add(open_loop_error(replay_open_loop(model, r), r));
  return error.rms_m();
}

TEST(WholeRecordings, GiveTheNumbersThatPredictThem) {
  const Session session = SimulatedSession(cart()).add_usual().get();
  const Model off = cart().set(P::viscous_coefficient, 5.4).set(P::coulomb_level, 0.45);
  const auto better = fitted_to_whole_recordings(off, session, {P::coulomb_level}, 1);
  ASSERT_TRUE(better);
  EXPECT_LT(open_loop_m(*better, session), 0.5 * open_loop_m(off, session));
  EXPECT_EQ((*better)[P::coulomb_level], 0.45);  // held
  EXPECT_NE((*better)[P::viscous_coefficient], 5.4);
}

/// A tether that the model lacks adds up over a recording, and numbers that make up for it are wrong at once.
TEST(WholeRecordings, AreNotFollowedWhereShortTimesLoseMoreByIt) {
  SimulatedSession simulated(cart().set(P::spring_stiffness, 2).set(P::spring_neutral, 0));
  for (const double rate_hz : {0.3, 0.4, 0.5, 0.6}) {
    simulated.add("slow_" + std::to_string(rate_hz) + ".csv", {80, 2}, 6,
                  [rate_hz](double t_s) { return 0.05 * std::sin(2 * std::numbers::pi * rate_hz * t_s); });
  }
  const Session& session = simulated.get();
  const auto found = identify(session, *TermSet::create({Term::viscous_friction, Term::coulomb_friction}));
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_TRUE(fit_by_simulation(session, found->model));
  EXPECT_FALSE(fitted_to_whole_recordings(found->model, session, {}, 1));
}

TEST(WholeRecordings, LeaveAloneWhatCannotBeSimulated) {
  Session session =
      SimulatedSession(cart()).add("short.csv", {60, 0}, 0.05, [](double) { return 0.1; }).get();
  EXPECT_FALSE(fitted_to_whole_recordings(cart(), session, {}, 1));
}

TEST(EstimateOf, HoldsBothWhereTheModelHasAnotherNumber) {
  Fit fit;
  fit.model = cart();
  fit.free = {{P::coulomb_level, 1, 0, 10, false}};
  fit.covariance = Eigen::MatrixXd::Constant(1, 1, 0.01);
  const Estimate same = estimate_of(cart(), fit, P::coulomb_level);
  EXPECT_EQ(same.low, estimate(fit, P::coulomb_level).low);
  EXPECT_EQ(same.high, estimate(fit, P::coulomb_level).high);
  const Estimate moved = estimate_of(cart(0.6), fit, P::coulomb_level);
  EXPECT_EQ(moved.value, 0.6);
  EXPECT_DOUBLE_EQ(moved.low, same.low);
  EXPECT_DOUBLE_EQ(moved.high - moved.value, moved.value - moved.low);
}

}  // namespace
}  // namespace cartwright
