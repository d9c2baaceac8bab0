#include "host/session/motion_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "host/statistics/sample.hpp"

namespace cartwright {

MotionRange motion_range_of(std::span<const Recording> recordings) {
  constexpr double kSpeedSpan_s = 0.02;
  std::vector<double> position, speed;
  for (const Recording& r : recordings) {
    position.insert(position.end(), r.y_m.begin(), r.y_m.end());
    if (r.size() < 2) continue;
    std::vector<double> steps_s;
    for (std::size_t k = 1; k < r.size(); ++k) steps_s.push_back(r.t_s[k] - r.t_s[k - 1]);
    const double period_s = percentile(std::move(steps_s), 0.5);
    const auto span = static_cast<std::size_t>(std::max(1L, std::lround(kSpeedSpan_s / period_s)));
    for (std::size_t k = span; k < r.size(); ++k) {
      speed.push_back(std::abs(r.y_m[k] - r.y_m[k - span]) / (r.t_s[k] - r.t_s[k - span]));
    }
  }
  MotionRange motion;
  motion.position_low_m = percentile(position, 0.001);
  motion.position_high_m = percentile(position, 0.999);
  motion.typical_speed_m_per_s = root_mean_square(speed);
  // Of a cart that hardly ever moves the percentile is zero.
  motion.most_speed_m_per_s = std::max(percentile(speed, 0.99), motion.typical_speed_m_per_s);
  return motion;
}

}  // namespace cartwright
