#include "host/session/gaps.hpp"

#include <fmt/format.h>

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

std::vector<std::string> gaps_in_words(const Session& session) {
  std::vector<std::string> lines;
  for (const Recording& recording : session.recordings) {
    const std::vector<Gap> gaps = find_gaps(recording.t_s);
    if (gaps.empty()) continue;
    double rows = 0;
    for (const Gap& gap : gaps) rows += gap.lost_ticks;
    lines.push_back(fmt::format("{}: {:.0f} rows are missing in {} gap{}, the first after t_s = {:.6g}",
                                recording.file, rows, gaps.size(), gaps.size() == 1 ? "" : "s",
                                gaps.front().from_s));
  }
  return lines;
}

}  // namespace cartwright
