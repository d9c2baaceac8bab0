#include "host/diagnose/judge/left_over.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cartwright {
namespace {

constexpr std::size_t kPeriodsTold = 3;

}  // namespace

Unexplained left_over(const Diagnosis& diagnosis, double share_left, const std::string& why_refused) {
  Unexplained left;
  left.share_left = share_left;
  left.where = where_of(diagnosis.after);
  const Profile& over_way = (!why_refused.empty() ? diagnosis.before : diagnosis.after).over_way;
  for (const std::size_t i : over_way.lines(kPeriodsTold)) left.periods_m.push_back(1 / over_way.at[i]);
  const std::vector<AxisMap>& axes = diagnosis.after.axes;
  const auto carrier = std::max_element(axes.begin(), axes.end(), [](const AxisMap& a, const AxisMap& b) {
    return a.gain - a.bar < b.gain - b.bar;
  });
  if (carrier != axes.end()) left.axis = carrier->axis, left.curve = *carrier;
  const Search& found = diagnosis.search;
  if (!found.contests.empty()) {
    left.closest = found.contests.front().chosen;
  } else if (!found.promises.empty()) {
    left.closest = found.promises.front().term;
  }
  if (left.closest && !why_refused.empty())
    left.why_refused = fmt::format("{} comes closest, but with it {}", info(*left.closest).name, why_refused);
  return left;
}

}  // namespace cartwright
