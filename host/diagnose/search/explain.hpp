#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "host/diagnose/search/explanation.hpp"
#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// What stood beside an effect when it was chosen.
struct Contest {
  Term chosen;
  double gain = 0;                        ///< of the chosen over doing without, in nats, net of its numbers
  double without = 0;                     ///< score of doing without, as it stood then
  Explanation winner;                     ///< with the chosen, told last, as it stood then
  std::vector<Explanation> alternatives;  ///< other terms in its place, best first
  Explanation before;                     ///< `best` without the chosen, everything else refitted
};

struct Search {
  Fit nominal;           ///< as given, only the noise fitted
  Explanation refitted;  ///< nominal terms, numbers refitted
  Explanation best;
  std::vector<Contest> contests;  ///< one per effect of `best`
  std::vector<Promise> promises;  ///< of the first screening: what each term seemed to be worth
};

struct SearchOptions {
  unsigned threads = 2;
  std::size_t most_effects = 3;  ///< besides the terms that every cart has: viscous, Coulomb, constant force
  /// What an effect must gain, told from the refitted nominal model; `kLeastGain` if not given.
  std::function<double(const Fit& refitted)> least_gain;
  std::optional<FitOptions> fit;  ///< those for the session and the nominal model, if none are given
  std::vector<Parameter> held;    ///< of the nominal model: kept as given, because this session cannot tell
  std::function<void(std::string_view what, double share_done)> progress;
};

/// Refits the nominal model, then adds one effect at a time from the whole vocabulary, each time the one that
/// explains most with everything refitted, until none is worth its numbers. After each, rivals of the earlier
/// ones are asked again in their places, and what has become redundant is dropped.
Search explain(const Session& session, const Model& nominal, const SearchOptions& options = {});

}  // namespace cartwright
