#pragma once

#include <cstddef>
#include <vector>

namespace cartwright {

/// A stretch of time without rows inside a recording.
struct Gap {
  std::size_t row;    ///< the first row after it
  double from_s;      ///< time of the last row before it
  double to_s;        ///< time of `row`
  double lost_ticks;  ///< how many rows should have been there, rounded
};

/// The longest step between two rows, in periods, that still counts as jitter. At 1.5 the step is nearer to
/// two periods than to one, so a row is missing.
inline constexpr double kGapPeriods = 1.5;

/// Where a recording of the given tick period has lost rows. `time_s` increases strictly.
std::vector<Gap> find_gaps(const std::vector<double>& time_s, double period_s);

}  // namespace cartwright
