#include "host/diagnose/locate/where.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {

double structure_left(const Location& location) {
  double most = 0;
  for (const AxisMap& map : location.axes) {
    if (!map.flat()) most = std::max(most, map.gain);
  }
  const Profile& over_frequency = location.over_frequency;
  if (!over_frequency.flat()) {
    const double looks = static_cast<double>(over_frequency.at.size());
    most = std::max(most, over_frequency.value[over_frequency.strongest()] - std::log(looks));
  }
  return most;
}

Where nowhere() {
  return {{"time_s", {}},    {"position_m", {}},   {"velocity_m_per_s", {}},
          {"voltage_V", {}}, {"frequency_hz", {}}, {"after_reversal_m", {}}};
}

Where where_of(const Location& location) {
  Where where = nowhere();
  for (const AxisMap& map : location.axes) {
    if (map.flat() || !where.contains(map.axis)) continue;
    if (const auto stretch = map.stretch(); !stretch.empty()) where[map.axis] = stretch;
  }
  const Profile& over_frequency = location.over_frequency;
  if (!over_frequency.flat()) where["frequency_hz"].assign(2, over_frequency.at[over_frequency.strongest()]);
  return where;
}

}  // namespace cartwright
