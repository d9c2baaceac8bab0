#pragma once

#include <string>
#include <vector>

#include "host/diagnose/observe/observer.hpp"

namespace cartwright {

/// One axis a mismatch may sit on: the bin of every row, and the direction its push is counted in.
struct AxisBins {
  std::string axis, parity;
  std::vector<double> edges;                        ///< bins + 1 of them
  std::vector<std::vector<int>> bin;                ///< per recording and row; -1: in none
  std::vector<std::vector<signed char>> direction;  ///< per recording and row: factor of the push
  std::vector<std::string> names;                   ///< of the bins, where they are no numbers
};

/// The axes of a session as seen by its observer: time, recording, position, velocity, acceleration, voltage,
/// direction and distance since reversal. Bins hold equal numbers of moving rows.
std::vector<AxisBins> axes_of(const Session& session, const std::vector<Observation>& seen,
                              std::size_t bins = 12);

}  // namespace cartwright
