#include "host/session/gaps.hpp"

#include <cmath>

#include "host/session/segments.hpp"

namespace cartwright {

std::vector<Gap> find_gaps(const std::vector<double>& time_s) {
  const double period_s = median_period_s(time_s);
  std::vector<Gap> gaps;
  for (const Segment& segment : segments(time_s)) {
    if (segment.first == 0) continue;
    const double from_s = time_s[segment.first - 1], to_s = time_s[segment.first];
    gaps.push_back(
        {segment.first, from_s, to_s, std::round((to_s - from_s) / period_s) - 1, to_s - from_s - period_s});
  }
  return gaps;
}

}  // namespace cartwright
