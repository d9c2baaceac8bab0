#include "host/session/motion_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cartwright {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

MotionRange motion_range_of(std::span<const Recording> recordings) {
  constexpr double kSpeedSpan_s = 0.02;
  std::vector<double> position, speed;
  for (const Recording& r : recordings) {
    position.insert(position.end(), r.y_m.begin(), r.y_m.end());
    if (r.size() < 2) continue;
    const double period_s = (r.t_s.back() - r.t_s.front()) / static_cast<double>(r.size() - 1);
    const auto span = static_cast<std::size_t>(std::max(1L, std::lround(kSpeedSpan_s / period_s)));
    for (std::size_t k = span; k < r.size(); ++k) {
      speed.push_back(std::abs(r.y_m[k] - r.y_m[k - span]) / (r.t_s[k] - r.t_s[k - span]));
    }
  }
  MotionRange motion;
  motion.position_low_m = percentile(position, 0.001);
  motion.position_high_m = percentile(position, 0.999);
  motion.most_speed_m_per_s = percentile(speed, 0.99);
  motion.typical_speed_m_per_s = root_mean_square(speed);
  return motion;
}

}  // namespace cartwright
