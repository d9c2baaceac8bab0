#include "host/diagnose/promises.hpp"

#include <algorithm>

#include "host/diagnose/scan.hpp"

namespace cartwright {

bool two_masses(Term term) {
  return term == Term::backlash || term == Term::flexible_coupling;
}

std::vector<Promise> all_promises(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads) {
  std::vector<Promise> promises = screen(session, base, candidates(base.model, facts), options, threads);
  for (const auto& found :
       {scan_periods(session, base, facts, options, threads), scan_pushes(session, base, facts, options)}) {
    promises.insert(promises.end(), found.begin(), found.end());
  }
  std::stable_sort(promises.begin(), promises.end(), [](const Promise& a, const Promise& b) {
    return a.log_likelihood_gain > b.log_likelihood_gain;
  });
  return promises;
}

}  // namespace cartwright
