#include "host/diagnose/search/worth_fitting.hpp"

#include <gmock/gmock.h>

namespace cartwright {
namespace {

using testing::ElementsAre;

Promise promise(Term term, double nats) {
  Promise one;
  one.term = term;
  one.log_likelihood_gain = nats;
  return one;
}

std::vector<Term> fitted(const std::vector<Promise>& promises, const Explanation& base = {}) {
  std::vector<Term> terms;
  for (const Promise& one : worth_fitting(promises, kLeastGain, base)) terms.push_back(one.term);
  return terms;
}

TEST(WorthFitting, AGapOnlyWhereItPromisesMoreThanACoupling) {
  const Promise gap = promise(Term::backlash, 100), more = promise(Term::flexible_coupling, 120),
                less = promise(Term::flexible_coupling, 80);
  EXPECT_THAT(fitted({gap, less}), ElementsAre(Term::backlash, Term::flexible_coupling));
  EXPECT_THAT(fitted({more, gap}), ElementsAre(Term::flexible_coupling));
}

TEST(WorthFitting, NoTwoMassesAsTheThirdEffect) {
  Explanation base;
  base.effects = {Term::cogging, Term::armature_lag};
  EXPECT_THAT(fitted({promise(Term::flexible_coupling, 100), promise(Term::quadratic_drag, 50)}, base),
              ElementsAre(Term::quadratic_drag));
  base.effects.back() = Term::coulomb_friction;  // every cart has it
  EXPECT_THAT(fitted({promise(Term::flexible_coupling, 100), promise(Term::quadratic_drag, 50)}, base),
              ElementsAre(Term::flexible_coupling, Term::quadratic_drag));
}

TEST(WorthFitting, NothingThatIsFarFromWhatItHasToGain) {
  EXPECT_THAT(fitted({promise(Term::cogging, 1000), promise(Term::quadratic_drag, 20)}),
              ElementsAre(Term::cogging));
  EXPECT_THAT(fitted({promise(Term::quadratic_drag, 2)}), ElementsAre());
}

}  // namespace
}  // namespace cartwright
