#include "host/diagnose/search/refits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using testing::ElementsAre;
using P = Parameter;

/// One recording of a cart whose rail is tilted, and what may be said of it.
class Refits : public testing::Test {
 protected:
  Refits() {
    test::IndependentCart cart;
    cart.push = [](double, double, double) { return 0.2; };
    session_ = test::battery(cart);
    session_.recordings = {session_.recordings[5]};
    options_ = options_for(session_, test::nominal());
  }

  Explanation with(std::vector<Term> effects, const Model& model) {
    std::vector<FreeParameter> free = free_parameters(model, facts_of(session_));
    return {std::move(effects), fit(session_, model, {}, free, options_), {}};
  }

  Session session_;
  FitOptions options_;
};

TEST_F(Refits, ARivalTakesThePlaceOfOneEffectAndLeavesTheOthers) {
  const Explanation from =
      with({Term::quadratic_drag, Term::constant_force},
           test::nominal().set(P::drag_coefficient, 0.1).set(P::constant_acceleration, 0.1));
  const Explanation rival =
      with({Term::cable_spring}, test::nominal().set(P::spring_stiffness, 0.5).set(P::spring_neutral, 0));
  const Explanation swapped = in_place_of(session_, from, 0, rival, 0, options_);
  EXPECT_THAT(swapped.effects, ElementsAre(Term::cable_spring, Term::constant_force));
  EXPECT_FALSE(swapped.fit.model.has(Term::quadratic_drag));
  EXPECT_NEAR(swapped.fit.model[P::constant_acceleration], 0.2, 0.05);
  EXPECT_THAT(with_last(swapped, 0).effects, ElementsAre(Term::constant_force, Term::cable_spring));
}

TEST_F(Refits, DoingWithoutWhatIsThereCostsWhatItGained) {
  const Explanation with_push =
      with({Term::constant_force}, test::nominal().set(P::constant_acceleration, 0.1));
  const Explanation without = doing_without(session_, with_push, 0, options_);
  EXPECT_THAT(without.effects, ElementsAre());
  EXPECT_FALSE(without.fit.model.has(Term::constant_force));
  EXPECT_GT(with_push.score() - without.score(), kLeastGain);
}

TEST_F(Refits, ASketchIsFittedToTheEnd) {
  FitOptions quick = of_sketch(options_);
  quick.most_iterations = 1;
  const Model start = test::nominal();
  const Fit sketch = fit(session_, start, {}, free_parameters(start, facts_of(session_)), quick);
  const Fit whole = finished(session_, sketch, options_);
  EXPECT_GE(whole.log_likelihood, sketch.log_likelihood);
  EXPECT_GT(whole.covariance.size(), 0);
}

}  // namespace
}  // namespace cartwright
