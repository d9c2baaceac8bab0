#pragma once

#include <vector>

#include "host/relay/sinefit.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One period of an oscillation: rows [first, last) between two upward passages through the reference.
struct Cycle {
  std::size_t first = 0, last = 0;
  double period_s = 0;
  double amplitude_m = 0;  ///< half of highest less lowest
  double offset_m = 0;     ///< mean of highest and lowest, less the reference
};

/// A relay recording that went over into a steady oscillation.
struct LimitCycle {
  std::vector<Cycle> cycles;     ///< all of them, the transient too
  std::size_t settled_from = 0;  ///< first cycle of the steady part
  double settled_s = 0;          ///< when it begins
  SineFit sine;                  ///< of the steady part: amplitude [m], frequency, offset [m]
};

/// Finds the cycles of a relay recording, where they have settled, and whether they converged.
///
/// Settled: from there on period and amplitude of every cycle are within 3 % of those of the last two.
/// Converged: they changed by less than 3 % in the last cycle and 6 % in the one before, and the offset does
/// not wander. Fails with the reason otherwise: it dies out, sticks, drifts, still grows or shrinks, or is
/// too short.
Result<LimitCycle> find_limit_cycle(const Recording& recording, const Rig& rig);

}  // namespace cartwright
