#pragma once

#include "host/diagnose/search/explain.hpp"

namespace cartwright::blind {

/// One term on top of the refitted nominal model, everything refitted alongside.
struct OneMore {
  Term term;
  Fit fit;
  std::vector<ReadingJump> jumps;  ///< put right where counts were lost
};

/// A model fitted to a session and the most promising terms on top of it: the candidates that the
/// baselines choose from. No rule has been applied: neither that a term must gain something nor that its
/// numbers must be plausible.
struct OneRound {
  Fit base;
  std::vector<OneMore> tried;  ///< one per term, greatest gain first
};

/// Fits the `most_terms` terms with the greatest promises on top of `base`, each from its best start, by the
/// product's own likelihood. Two masses cost ten times the time of one: they take part where they promise at
/// least a quarter of the best. `promises` are those of `base` on the same session (screening and scans).
OneRound one_round(const Session& session, const Fit& base, const std::vector<Promise>& promises,
                   std::size_t most_terms = 5);

/// The same, screening first.
OneRound one_round(const Session& session, const Fit& base, std::size_t most_terms = 5);

/// The same from scratch: refits the nominal model first.
OneRound one_round(const Session& session, const Model& nominal, std::size_t most_terms = 5);

}  // namespace cartwright::blind
