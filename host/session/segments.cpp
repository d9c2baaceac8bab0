#include "host/session/segments.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> steps(std::span<const double> t_s) {
  std::vector<double> out;
  out.reserve(t_s.size());
  for (std::size_t row = 1; row < t_s.size(); ++row) out.push_back(t_s[row] - t_s[row - 1]);
  return out;
}

}  // namespace

double median_period_s(std::span<const double> t_s) {
  if (t_s.size() < 2) return 0;
  std::vector<double> step_s = steps(t_s);
  return median(step_s);
}

std::vector<Segment> segments(std::span<const double> t_s) {
  if (t_s.empty()) return {};
  if (t_s.size() == 1) return {{0, 1}};
  const std::vector<double> step_s = steps(t_s);
  std::vector<double> work = step_s;
  const double period_s = median(work);
  for (double& value : work) value = std::abs(value - period_s);
  const double slack_s = std::max(0.5 * period_s, 10 * median(work));

  std::vector<Segment> out{{0, t_s.size()}};
  for (std::size_t k = 0; k < step_s.size(); ++k) {
    if (step_s[k] <= period_s + slack_s) continue;
    const bool made_up = k + 1 < step_s.size() && step_s[k] + step_s[k + 1] <= 2 * period_s + slack_s;
    if (made_up) continue;
    out.back().last = k + 1;
    out.push_back({k + 1, t_s.size()});
  }
  return out;
}

}  // namespace cartwright
