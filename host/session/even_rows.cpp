#include "host/session/even_rows.hpp"

#include <algorithm>
#include <cmath>

#include "host/session/segments.hpp"

namespace cartwright {
namespace {

using Values = std::vector<double>;

/// Straight line through rows k and k + 1, at time t.
double between(const Values& t_s, const Values& values, std::size_t k, double t) {
  if (k + 1 >= values.size()) return values[k];
  const double share = (t - t_s[k]) / (t_s[k + 1] - t_s[k]);
  return values[k] + std::clamp(share, 0.0, 1.0) * (values[k + 1] - values[k]);
}

/// Mean over [from, to] of what holds from each row to the next; the last row before `end` holds on.
double mean_held(const Values& t_s, const Values& values, std::size_t k, std::size_t end, double from,
                 double to) {
  double sum = 0;
  for (double at = from; at < to; ++k) {
    const double until = k + 1 < end ? std::min(t_s[k + 1], to) : to;
    sum += values[k] * (until - at);
    at = until;
  }
  return sum / (to - from);
}

/// The parts between gaps; rows that lie no further apart than one and a half new ticks leave none.
std::vector<Segment> parts_between_gaps(const Values& t_s, double rate_hz) {
  std::vector<Segment> joined;
  for (const Segment& part : segments(t_s)) {
    const bool near = !joined.empty() && t_s[part.first] - t_s[part.first - 1] <= 1.5 / rate_hz;
    if (near) {
      joined.back().last = part.last;
    } else {
      joined.push_back(part);
    }
  }
  return joined;
}

}  // namespace

RowSpacing row_spacing(std::span<const double> t_s) {
  RowSpacing spacing;
  const std::vector<Segment> parts = segments(t_s);
  spacing.median_s = median_period_s(t_s);
  spacing.gaps = parts.empty() ? 0 : parts.size() - 1;
  spacing.least_s = spacing.most_s = spacing.median_s;
  for (const Segment& part : parts) {
    for (std::size_t row = part.first + 1; row < part.last; ++row) {
      const double step_s = t_s[row] - t_s[row - 1];
      spacing.least_s = std::min(spacing.least_s, step_s);
      spacing.most_s = std::max(spacing.most_s, step_s);
    }
  }
  return spacing;
}

Recording even_rows(const Recording& recording, double rate_hz) {
  const Values& t_s = recording.t_s;
  Recording out;
  out.file = recording.file;
  out.experiment = recording.experiment;
  out.controller = recording.controller;
  out.repeat_of = recording.repeat_of;
  for (const auto& [name, values] : recording.other_columns) out.other_columns[name];
  double tick = 0;  // of the next row to make
  for (const Segment& part : parts_between_gaps(t_s, rate_hz)) {
    tick = std::max(tick, std::ceil((t_s[part.first] - t_s[0]) * rate_hz - 1e-9));
    for (std::size_t k = part.first;; ++tick) {
      const double t = t_s[0] + tick / rate_hz;
      if (t > t_s[part.last - 1]) break;
      while (k + 1 < part.last && t_s[k + 1] <= t) ++k;
      const auto held = [&](const Values& values) {
        return mean_held(t_s, values, k, part.last, t, t + 1 / rate_hz);
      };
      out.t_s.push_back(t);
      out.y_m.push_back(between(t_s, recording.y_m, k, t));
      out.u_V.push_back(held(recording.u_V));
      if (!recording.r_m.empty()) out.r_m.push_back(between(t_s, recording.r_m, k, t));
      if (!recording.d_V.empty()) out.d_V.push_back(held(recording.d_V));
      for (const auto& [name, values] : recording.other_columns)
        out.other_columns[name].push_back(between(t_s, values, k, t));
    }
  }
  return out;
}

}  // namespace cartwright
