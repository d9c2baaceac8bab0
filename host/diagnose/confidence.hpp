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
  double rivals = 0;      ///< the other terms, each counted by how near it comes: 1 for one that does as well
  double share_left = 0;  ///< of what was missing and is still there, where that is beyond chance
  int equivalent = 0;     ///< terms that this data cannot tell from it
  int at_bound = 0;       ///< its numbers that ended at the end of their range
};

/// How often a name given on such evidence is right.
double confidence(const Evidence& evidence);

}  // namespace cartwright
