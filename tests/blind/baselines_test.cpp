#include <gmock/gmock.h>

#include <random>

#include "host/diagnose/judge/held_out.hpp"
#include "tests/blind/baselines/rules.hpp"
#include "tests/blind/baselines/sparse.hpp"
#include "tests/blind/baselines/stlsq.hpp"
#include "tests/blind/battery.hpp"
#include "tests/blind/null.hpp"

namespace cartwright::blind {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using P = Parameter;

/// A cart of moderate noise; four of its recordings keep the test short.
Session short_session(const CartPhysics& physics) {
  return only(battery(physics, 7), {1, 2, 5, 6});
}

Model nominal() {
  return Model(1.87).set(P::viscous_coefficient, 5.1).set(P::coulomb_level, 0.41);
}

CartPhysics with_drag() {
  CartPhysics physics;
  physics.drag_per_m = 3;
  return physics;
}

NormalEquations regression(double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  NormalEquations sums(6);
  Eigen::VectorXd row(6);
  for (int i = 0; i < 300; ++i) {
    for (Eigen::Index c = 0; c < 6; ++c) row[c] = normal(random);
    sums.add_row(row, 2 * row[0] - 0.5 * row[3] + noise * normal(random));
  }
  sums.mirror();
  return sums;
}

TEST(Stlsq, FindsTheColumnsThatCountAndDropsTheRest) {
  const Eigen::VectorXd found = stlsq(regression(0.1, 1), 0.1, 1);
  EXPECT_NEAR(found[0], 2, 0.05);
  EXPECT_NEAR(found[3], -0.5, 0.05);
  for (const Eigen::Index c : {1, 2, 4, 5}) EXPECT_EQ(found[c], 0);
}

TEST(Stlsq, NeverDropsAColumnThatIsToBeKept) {
  const Eigen::VectorXd found = stlsq(regression(0.1, 2), 0.9, 2);
  EXPECT_NE(found[1], 0);
  EXPECT_EQ(found[3], 0);
}

TEST(Stlsq, ChoosesAThresholdThatKeepsTheTruthOnly) {
  std::vector<NormalEquations> parts;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) parts.push_back(regression(0.3, seed));
  const Eigen::VectorXd found = stlsq_cross_validated(parts, 1);
  EXPECT_NE(found[3], 0);
  for (const Eigen::Index c : {1, 2, 4, 5}) EXPECT_EQ(found[c], 0);
}

TEST(Stlsq, TheSquaresThatItLeavesAreThoseOfTheRows) {
  NormalEquations sums(1);
  sums.add_row(Eigen::VectorXd::Constant(1, 2.0), 3);
  sums.add_row(Eigen::VectorXd::Constant(1, 1.0), 1);
  sums.mirror();
  EXPECT_NEAR(sums.left(Eigen::VectorXd::Constant(1, 1.5)), 0 + 0.25, 1e-12);
}

TEST(SparseRegression, InWeakFormNamesStrongDrag) {
  const auto names = sparse_in_weak_form(short_session(with_drag()), nominal());
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front(), "quadratic_drag");
}

TEST(SparseRegression, ByDerivativesFindsAStrongSpring) {
  CartPhysics physics;
  physics.spring_per_s2 = 15;
  EXPECT_THAT(sparse_by_derivatives(short_session(physics), nominal()), Contains("cable_spring"));
}

TEST(RulesOfTheBaselines, AllNameStrongDrag) {
  const Session session = short_session(with_drag());
  const OneRound round = one_round(session, nominal(), 2);
  ASSERT_FALSE(round.tried.empty());
  EXPECT_THAT(most_gain(round), ElementsAre("quadratic_drag"));
  EXPECT_THAT(bic_of_windows(session, round), ElementsAre("quadratic_drag"));
  EXPECT_EQ(stepwise_bic(session, round).front(), "quadratic_drag");
}

TEST(RulesOfTheBaselines, NameNothingOnlyWhereNothingGains) {
  OneRound round;
  round.base.log_likelihood = 100, round.base.rows = 1000;
  EXPECT_THAT(most_gain(round), IsEmpty());
  OneMore little{Term::quadratic_drag, {}, {}};
  little.fit.log_likelihood = 101;
  little.fit.free.resize(1);
  round.tried.push_back(little);
  // Half the log of 1000 rows, 3.5 nats, is more than the one it gains.
  EXPECT_THAT(stepwise_bic({}, round), IsEmpty());
  EXPECT_THAT(most_gain(round), ElementsAre("quadratic_drag"));
}

TEST(SurrogatesOfNothing, HoldNothingThatWouldBeNamed) {
  for (const double gain : greatest_gains_of_nothing(short_session({}), nominal(), 1, 3)) {
    EXPECT_GE(gain, 0);
    EXPECT_LT(gain, kLeastGain);
  }
}

}  // namespace
}  // namespace cartwright::blind
