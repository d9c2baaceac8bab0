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
///     w = exp(-behind / T)
///
/// T = 1 would be the posterior odds of two models of equal prior chance whose likelihood is right in all; it
/// is 1.5, because one-step errors keep some colour and no law is quite the cart's.
double weight_of_rival(double behind_nats);

/// How often a name given on such evidence is right,
///
///     p = p_most (1 - exp(-gain / g)) (1 - left) / (1 + sum w)   [less where a number is at its bound]
///
/// that it is real at all, that what is left does not belong to something else, and that it is this one and
/// no rival. It grows with gain and margin and falls with what is left. `p_most` is no more than the
/// calibration can vouch for (see the .cpp): nothing is ever certain.
double confidence(const Evidence& evidence);

}  // namespace cartwright
