#include "tests/blind/baselines/one_round.hpp"

#include <algorithm>
#include <set>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/search/lost_counts.hpp"
#include "host/diagnose/search/promises.hpp"
#include "host/diagnose/search/worth_fitting.hpp"

namespace cartwright::blind {
namespace {

FitOptions quick(const Session& session, const Fit& base) {
  FitOptions options = options_for(session, base.model);
  options.outlier_m = kOutlierOverNoise * robust_size(base);
  options.most_rounds = 2;
  options.most_iterations = 6;
  options.tolerance = 1.0;
  options.finest_noise_step = 0.15;
  return options;
}

/// The best start of each term, strongest first.
std::vector<Promise> chosen(const std::vector<Promise>& promises, std::size_t most) {
  std::vector<Promise> chosen;
  std::set<Term> seen;
  for (const Promise& promise : promises) {
    if (chosen.size() >= most || promise.log_likelihood_gain <= 0) break;
    const double least = kLeastShareOfTwoMasses * promises.front().log_likelihood_gain;
    if (two_masses(promise.term) && promise.log_likelihood_gain < least) continue;
    if (seen.insert(promise.term).second) chosen.push_back(promise);
  }
  return chosen;
}

}  // namespace

OneRound one_round(const Session& session, const Fit& base, const std::vector<Promise>& promises,
                   std::size_t most_terms) {
  OneRound round{base, {}};
  const FitOptions options = quick(session, base);
  for (const Promise& promise : chosen(promises, most_terms)) {
    FitOptions own = options;
    if (two_masses(promise.term)) own.most_rounds = 1, own.most_iterations = 3;
    if (promise.term == Term::backlash) own.difference_step = kStepOverKinks;
    round.tried.push_back({promise.term, fit(session, promise.start, base.noise, promise.free, own), {}});
  }
  const std::vector<ReadingJump> jumps = scan_jumps(session, base, options);
  if (like_lost_counts(session, jumps)) {
    OneMore lost{Term::encoder_missed_counts, {}, jumps};
    lost.fit = fit(without_jumps(session, jumps), base.model, base.noise, base.free, options);
    round.tried.push_back(std::move(lost));
  }
  std::stable_sort(round.tried.begin(), round.tried.end(), [](const OneMore& a, const OneMore& b) {
    return a.fit.log_likelihood > b.fit.log_likelihood;
  });
  return round;
}

OneRound one_round(const Session& session, const Fit& base, std::size_t most_terms) {
  return one_round(session, base, all_promises(session, base, facts_of(session), quick(session, base), 1),
                   most_terms);
}

OneRound one_round(const Session& session, const Model& nominal, std::size_t most_terms) {
  FitOptions options = options_for(session, nominal);
  const NoiseModel noise = search_noise(session, nominal, options);
  const Fit first = fit(session, nominal, noise, free_parameters(nominal, facts_of(session)), options);
  options.outlier_m = kOutlierOverNoise * robust_size(first);
  return one_round(session, fit(session, first.model, first.noise, first.free, options), most_terms);
}

}  // namespace cartwright::blind
