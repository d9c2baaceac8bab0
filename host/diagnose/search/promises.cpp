#include "host/diagnose/search/promises.hpp"

#include <algorithm>

#include "host/diagnose/search/scan.hpp"

namespace cartwright {

bool two_masses(Term term) {
  return term == Term::backlash || term == Term::flexible_coupling;
}

std::vector<Promise> all_promises(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads) {
  std::vector<Promise> promises = screen(session, base, candidates(base.model, facts), options, threads);
  const auto add = [&](const std::vector<Promise>& found) {
    promises.insert(promises.end(), found.begin(), found.end());
  };
  add(scan_periods(session, base, facts, options, threads));
  if (!base.model.has(Term::external_disturbance)) add(scan_pushes(session, base, facts, options));
  std::stable_sort(promises.begin(), promises.end(), [](const Promise& a, const Promise& b) {
    return a.log_likelihood_gain > b.log_likelihood_gain;
  });
  return promises;
}

}  // namespace cartwright
