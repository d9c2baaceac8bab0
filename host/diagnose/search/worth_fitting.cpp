#include "host/diagnose/search/worth_fitting.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "host/diagnose/search/promises.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kTermsFitted = 5;      // most terms fitted after a screening
constexpr std::size_t kTermsFittedSlow = 2;  // the same on top of two masses, which cost ten times the time
/// With so many effects found, two masses would be the third; they cost more than all other candidates
/// together.
constexpr std::size_t kEffectsBeforeTwoMasses = 2;
constexpr std::size_t kStartsFitted = 2;    // most starts of one term; beside a gap it evolves from one
constexpr double kLeastPromise = 3.0;       // nats, to be fitted at all
constexpr double kLeastShareOfBest = 0.03;  // of the best promise
/// The same beside a gap, where each costs an evolution; there nothing is hidden (promises_beside_gap.hpp),
/// and a term must promise all that it has to gain.
constexpr double kLeastShareOfBestBesideGap = 0.3;
constexpr double kMostGainOverPromiseBesideGap = 1;

bool many_minima(Term term) {
  return two_masses(term) || term == Term::cogging || term == Term::encoder_eccentricity ||
         term == Term::stribeck_friction || term == Term::position_dependent_friction;
}

/// Which of a term's laws: before it breaks away friction is elastic, or gives all along, its damping with
/// it or fading.
using Law = std::pair<double, bool>;
Law law_of(const Promise& promise) {
  return {promise.start[Parameter::presliding_dahl_exponent],
          std::isfinite(promise.start[Parameter::presliding_damping_speed])};
}

/// A coupling with play shows that play more than that it gives; where it is told the other way round, a
/// gap would be looked for in vain, at great cost.
bool gives_rather_than_plays(const std::vector<Promise>& promises) {
  const auto first =
      std::find_if(promises.begin(), promises.end(), [](const Promise& one) { return two_masses(one.term); });
  return first != promises.end() && !is_gap(*first);
}

}  // namespace

bool is_gap(const Promise& promise) {
  return promise.term == Term::backlash;
}

std::vector<Promise> worth_fitting(const std::vector<Promise>& promises, double least_gain,
                                   const Explanation& base) {
  const std::size_t most_terms = base.has_two_masses() ? kTermsFittedSlow : kTermsFitted;
  const bool beside_gap = base.has(Term::backlash);
  const std::size_t most_starts = beside_gap ? 1 : kStartsFitted;
  const double least_share = beside_gap ? kLeastShareOfBestBesideGap : kLeastShareOfBest;
  const double least_promise =
      least_gain / (beside_gap ? kMostGainOverPromiseBesideGap : kMostGainOverPromise);
  const bool no_gap = gives_rather_than_plays(promises);
  std::vector<Promise> chosen;
  std::map<Term, std::map<Law, std::size_t>> starts;  // of each law of each term
  for (const Promise& promise : promises) {
    const double bar =
        std::max({kLeastPromise, least_promise, least_share * promises.front().log_likelihood_gain});
    if (promise.log_likelihood_gain < bar) break;
    if (two_masses(promise.term) &&
        (base.effects_beyond_every_cart() >= kEffectsBeforeTwoMasses ||
         promise.log_likelihood_gain < kLeastShareOfTwoMasses * promises.front().log_likelihood_gain)) {
      continue;
    }
    if (is_gap(promise) && no_gap) continue;
    if (!starts.contains(promise.term) && starts.size() >= most_terms) continue;
    std::size_t& of_law = starts[promise.term][law_of(promise)];
    // A second start is worth its time only where it promises nearly as much.
    if (of_law >= most_starts) continue;
    if (of_law > 0 && !many_minima(promise.term)) continue;
    ++of_law;
    chosen.push_back(promise);
  }
  return chosen;
}

}  // namespace cartwright
