#include "host/diagnose/observe/rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host/session/motion_range.hpp"

namespace cartwright {
namespace {

constexpr double kTimesOverACount = 5;
constexpr double kMostCounts = 1.5;  // apart, and still within one count but for the digits of a file

/// Rows around which readings stay within one count for `reach` rows.
std::vector<bool> rows_at_rest(const Recording& recording, double count_m, std::size_t reach) {
  const std::size_t rows = recording.size();
  std::vector<bool> rests(rows, false);

  // The longest run of readings within one count that ends at each row.
  std::size_t begin = 0;
  double low = 0, high = 0;
  const auto takes = [&](std::size_t row) {
    const double y = recording.y_m[row];
    const double least = std::min(low, y), most = std::max(high, y);
    if (most - least > kMostCounts * count_m) return false;
    low = least, high = most;
    return true;
  };
  for (std::size_t end = 0; end < rows; ++end) {
    if (end == 0 || !takes(end)) {
      low = high = recording.y_m[end];
      for (begin = end; begin > 0 && takes(begin - 1);) --begin;
    }
    const std::size_t from = begin == 0 ? 0 : begin + reach;
    if (end + 1 == rows) {
      for (std::size_t k = from; k < rows; ++k) rests[k] = true;
    } else if (end >= from + reach) {
      rests[end - reach] = true;
    }
  }
  return rests;
}

}  // namespace

double time_at_rest_s(const Session& session) {
  const double count_m = session.rig.encoder_resolution_m;
  if (!(count_m > 0)) return 0;
  const MotionRange motion = motion_range_of(session.recordings);
  const double slow_m_per_s2 =
      std::pow(motion.most_speed_m_per_s, 2) / (2 * std::max(motion.travel_m(), count_m));
  return kTimesOverACount * std::sqrt(2 * count_m / slow_m_per_s2);
}

std::vector<std::vector<bool>> rows_at_rest(const Session& session, double time_s) {
  std::vector<std::vector<bool>> rests;
  for (const Recording& r : session.recordings) {
    if (!(time_s > 0)) {
      rests.emplace_back(r.size(), false);
      continue;
    }
    const double rows = std::min(time_s * session.rig.sample_rate_hz, static_cast<double>(r.size()));
    rests.push_back(rows_at_rest(r, session.rig.encoder_resolution_m, static_cast<std::size_t>(rows) + 1));
  }
  return rests;
}

}  // namespace cartwright
