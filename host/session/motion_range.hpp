#pragma once

#include <span>

#include "host/session/session.hpp"

namespace cartwright {

/// How far and how fast recordings move: what is small or large against that needs no unit.
struct MotionRange {
  double position_low_m = 0, position_high_m = 0;  ///< 0.1st and 99.9th percentile
  double most_speed_m_per_s = 0;                   ///< 99th percentile of the speed over 20 ms, no less than
  double typical_speed_m_per_s = 0;                ///< its root mean square
  double travel_m() const { return position_high_m - position_low_m; }
};
MotionRange motion_range_of(std::span<const Recording> recordings);

}  // namespace cartwright
