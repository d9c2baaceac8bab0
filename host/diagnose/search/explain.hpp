#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "host/diagnose/search/scan.hpp"

namespace cartwright {

/// One way to explain a session: the nominal terms and some effects, all numbers fitted jointly.
struct Explanation {
  std::vector<Term> effects;  ///< in the order they were found
  Fit fit;
  std::vector<ReadingJump> jumps;  ///< readings put right, where counts were lost

  /// Log-likelihood less what its numbers cost.
  double score() const;
  bool has(Term term) const;
  bool has_two_masses() const;
  /// A nominal model may lack what every cart has; that it is found must not end the search for the rest.
  std::size_t effects_beyond_every_cart() const;
};

/// Viscous and Coulomb friction, and a constant force.
bool every_cart_has(Term term);

/// What stood beside an effect when it was chosen.
struct Contest {
  Term chosen;
  double gain = 0;                        ///< of the chosen over doing without, in nats, net of its numbers
  Explanation winner;                     ///< with the chosen, as it stood then
  std::vector<Explanation> alternatives;  ///< other terms in its place, best first
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
  std::vector<Parameter> held;   ///< of the nominal model: kept as given, because this session cannot tell
  std::function<void(std::string_view what, double share_done)> progress;
};

/// Cost of one fitted number [nats]: half the log of the number of independent errors a session of a minute
/// holds (its blocks of 0.25 s times a few), the Bayesian information criterion's price.
inline constexpr double kCostPerNumber = 4.0;
/// An effect must gain this much, net of its numbers. Over some 300 looks (terms, starts, periods, places) at
/// noise alone the best gains about log(300) = 6; twice that leaves room for noise that is not quite white.
inline constexpr double kLeastGain = 12.0;
/// A further effect must gain this share of what the ones before it gained: less is the form of those being a
/// little off, not physics of its own.
inline constexpr double kLeastShareOfGain = 0.03;

/// Refits the nominal model, then adds one effect at a time from the whole vocabulary, each time the one that
/// explains most with everything refitted, until none is worth its numbers. After each, rivals of the earlier
/// ones are asked again in their places, and what has become redundant is dropped.
Search explain(const Session& session, const Model& nominal, const SearchOptions& options = {});

}  // namespace cartwright
