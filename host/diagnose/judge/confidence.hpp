#pragma once

#include <limits>

namespace cartwright {

/// What speaks for a name and against it.
struct Evidence {
  double gain_nats = 0;      ///< over doing without it, net of what its numbers cost
  double share_of_gain = 1;  ///< of what all effects named together gained
  /// Score of the nearest other term in its place, behind it; infinite where none came near enough to be
  /// fitted.
  double margin_nats = std::numeric_limits<double>::infinity();
  double rivals = 0;      ///< sum of `weight_of_rival` over the other terms in its place
  double share_left = 0;  ///< of what was missing and is still there, where that is beyond chance
  int equivalent = 0;     ///< terms that this data cannot tell from it
  int at_bound = 0;       ///< its numbers that ended at the end of their range
};

/// How much another term counts whose score is so many nats behind: 1 beside one that does as well.
///
///     w = exp(-behind)
///
/// the posterior odds of two terms of equal prior chance, the price of their numbers being in the score.
double weight_of_rival(double behind_nats);

/// How often a name given on such evidence is right,
///
///     p = p_most (1 - exp(-gain / g)) (1 - exp(-share / s)) (1 - left) / (1 + sum w)
///
/// (less where a number is at its bound): that it is real at all, that it is no bend of the other effects'
/// laws, that what is left does not belong to something else, and that it is this one and no rival. g and s
/// are what an effect must gain to be named, `kLeastGain` and `kLeastShareOfGain`. `p_most` is what the
/// calibration can vouch for: nothing is ever certain.
double confidence(const Evidence& evidence);

}  // namespace cartwright
