#include "host/identify/motion.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

/// Slope at the middle of the least-squares quadratic through rows [first, last), seen from time t.
double quadratic_slope(const std::vector<double>& t_s, const std::vector<double>& y_m, std::size_t first,
                       std::size_t last, std::size_t row) {
  double s1 = 0, s2 = 0, s3 = 0, s4 = 0, y0 = 0, y1 = 0, y2 = 0;
  // Times are scaled to the stretch, so that the powers stay comparable.
  const double scale = 1 / std::max(t_s[row] - t_s[first], t_s[last - 1] - t_s[row]);
  for (std::size_t i = first; i < last; ++i) {
    const double d = (t_s[i] - t_s[row]) * scale, y = y_m[i] - y_m[row], dd = d * d;
    s1 += d;
    s2 += dd;
    s3 += dd * d;
    s4 += dd * dd;
    y0 += y;
    y1 += d * y;
    y2 += dd * y;
  }
  const double n = static_cast<double>(last - first);
  // Cramer's rule for the middle unknown of the 3 x 3 normal equations.
  const double determinant = n * (s2 * s4 - s3 * s3) - s1 * (s1 * s4 - s3 * s2) + s2 * (s1 * s3 - s2 * s2);
  if (last - first < 3 || std::abs(determinant) < 1e-12)
    return scale * (n * y1 - s1 * y0) / (n * s2 - s1 * s1);
  const double slope = n * (y1 * s4 - s3 * y2) - y0 * (s1 * s4 - s3 * s2) + s2 * (s1 * y2 - s2 * y1);
  return scale * slope / determinant;
}

std::vector<double> velocities(const std::vector<double>& t_s, const std::vector<double>& y_m,
                               const std::vector<Segment>& stretches, double half_s) {
  std::vector<double> out(t_s.size(), 0.0);
  for (const Segment& stretch : stretches) {
    if (stretch.size() < 2) continue;
    std::size_t first = stretch.first, last = stretch.first;
    for (std::size_t row = stretch.first; row < stretch.last; ++row) {
      // At least three rows on either side, where the stretch has them.
      const std::size_t least_first = row < stretch.first + 3 ? stretch.first : row - 3;
      const std::size_t least_last = std::min(row + 4, stretch.last);
      while (first < least_first && t_s[first] < t_s[row] - half_s) ++first;
      while (last < stretch.last && (last < least_last || t_s[last] <= t_s[row] + half_s)) ++last;
      out[row] = quadratic_slope(t_s, y_m, first, last, row);
    }
  }
  return out;
}

/// Directions between rows, the velocity running straight from one to the next.
Velocity with_directions(std::vector<double> velocity) {
  Velocity out;
  out.at_m_per_s = std::move(velocity);
  const std::size_t rows = out.at_m_per_s.size();
  out.direction.assign(rows, 0.0);
  out.moving_share.assign(rows, 1.0);
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    const double v0 = out.at_m_per_s[row], v1 = out.at_m_per_s[row + 1], v = v0 + v1;
    out.direction[row] = v > 0 ? 1.0 : (v < 0 ? -1.0 : 0.0);
    if (v0 * v1 < 0) {
      out.direction[row] = std::copysign((std::abs(v0) - std::abs(v1)) / (std::abs(v0) + std::abs(v1)), v0);
    }
  }
  return out;
}

}  // namespace

double reading_step_m(const Recording& recording, const Rig& rig) {
  // Third differences take away the motion; white noise of deviation s leaves sqrt(20) s in them.
  std::vector<double> third;
  const std::vector<double>& y = recording.y_m;
  for (std::size_t i = 3; i < y.size(); ++i)
    third.push_back(std::abs(y[i] - 3 * y[i - 1] + 3 * y[i - 2] - y[i - 3]));
  if (third.empty()) return rig.encoder_resolution_m;
  const auto middle = third.begin() + static_cast<std::ptrdiff_t>(third.size() / 2);
  std::nth_element(third.begin(), middle, third.end());
  const double noise_m = *middle / 0.6745 / std::sqrt(20.0);
  return std::max(rig.encoder_resolution_m, std::sqrt(12.0) * noise_m);
}

Motion motion_of(const Recording& recording, const Rig& rig, const MotionOptions& options) {
  Motion out;
  const std::vector<Segment> stretches = segments(recording.t_s);
  out.velocity = with_directions(velocities(recording.t_s, recording.y_m, stretches, options.smoothing_s));
  const double threshold_m = options.stuck_counts * reading_step_m(recording, rig);
  const double period_s = median_period_s(recording.t_s);
  const auto half_rows = static_cast<std::size_t>(std::max(2.0, std::round(options.stuck_s / period_s)));
  for (const Segment& stretch : stretches) {
    bool was_moving = false;
    for (std::size_t row = stretch.first; row < stretch.last; ++row) {
      const std::size_t first = row < stretch.first + half_rows ? stretch.first : row - half_rows;
      const std::size_t last = std::min(row + half_rows + 1, stretch.last);
      const auto [least, most] =
          std::minmax_element(recording.y_m.begin() + static_cast<std::ptrdiff_t>(first),
                              recording.y_m.begin() + static_cast<std::ptrdiff_t>(last));
      const bool moving = *most - *least > threshold_m;
      if (moving && !was_moving) out.moving.push_back({row, row});
      if (moving) out.moving.back().last = row + 1;
      was_moving = moving;
    }
  }
  return out;
}

Velocity velocity_of(const std::vector<double>& t_s, const std::vector<double>& y_m,
                     const MotionOptions& options) {
  return with_directions(velocities(t_s, y_m, segments(t_s), options.smoothing_s));
}

}  // namespace cartwright
