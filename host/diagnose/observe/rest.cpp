#include "host/diagnose/observe/rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cartwright {
namespace {

constexpr double kAcceleration_m_per_s2 = 0.5;
constexpr double kTimesOverACount = 5;
constexpr double kMostCounts = 1.5;  // apart, and still within one count but for the digits of a file

}  // namespace

std::vector<bool> rows_at_rest(const Rig& rig, const Recording& recording) {
  const std::size_t rows = recording.size();
  const double count_m = rig.encoder_resolution_m;
  std::vector<bool> rests(rows, false);
  if (!(count_m > 0)) return rests;
  const double time_s = kTimesOverACount * std::sqrt(2 * count_m / kAcceleration_m_per_s2);
  const auto reach = static_cast<std::size_t>(time_s * rig.sample_rate_hz) + 1;

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

std::vector<std::vector<bool>> rows_at_rest(const Session& session) {
  std::vector<std::vector<bool>> rests;
  for (const Recording& r : session.recordings) rests.push_back(rows_at_rest(session.rig, r));
  return rests;
}

}  // namespace cartwright
