#pragma once

#include <vector>

#include "host/diagnose/search/scan.hpp"

namespace cartwright {

/// Cost of one fitted number [nats]: half the log of the number of independent errors a session of a minute
/// holds (its blocks of 0.25 s times a few), the Bayesian information criterion's price.
inline constexpr double kCostPerNumber = 4.0;
/// An effect must gain this much, net of its numbers. Over some 300 looks (terms, starts, periods, places) at
/// noise alone the best gains about log(300) = 6; twice that leaves room for noise that is not quite white.
inline constexpr double kLeastGain = 12.0;
/// A further effect must gain this share of what the ones before it gained: less is the form of those being a
/// little off, not physics of its own.
inline constexpr double kLeastShareOfGain = 0.03;

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

}  // namespace cartwright
