#pragma once

// What the two integrators share. Only plant_*.cpp include this.

#include <algorithm>
#include <cmath>

#include "common/model/plant.hpp"

namespace cartwright {

/// Events (stick, slip, breakaway, contact) located inside one inner step; after these the rest is taken as
/// it comes.
inline constexpr int kEventsPerStep = 16;
/// An event moves time on by at least this much.
inline constexpr double kLeastAdvance_s = 1e-12;

/// How many equal inner steps a span takes. A step may be a tenth longer than it should: ticks come a little
/// late, and one that does is not worth a step more.
inline int steps_over(double span_s, double step_s) noexcept {
  constexpr double kMostSteps = 1e9, kLonger = 0.1;
  return static_cast<int>(std::clamp(std::ceil(span_s / step_s - kLonger), 1.0, kMostSteps));
}

/// The fraction of a step at which a quantity changes sign, by a straight line; 1 where it does not.
inline double sign_change(double p0, double p1) noexcept {
  return p0 * p1 < 0 ? p0 / (p0 - p1) : 1.0;
}

struct BristleMode {
  double deflection_m;
  bool elastic;  ///< else it slides at its greatest deflection
};

/// `most_m` is the deflection that carries the friction level at this speed: a bristle slides where it moves
/// outwards with at least that, and unloads elastically whenever it moves back. `net` gives the net force
/// without friction in units of deflection, asked for only at a standstill.
template <typename Net>
BristleMode bristle_mode(double deflection_m, double velocity, double most_m, const Net& net) noexcept {
  if (most_m <= 0) return {0, false};
  if (std::abs(deflection_m) < most_m * (1 - 1e-9)) return {deflection_m, true};
  const double side = sign_of(deflection_m);
  const bool slides = velocity != 0 ? velocity * side > 0 : side * net() > most_m;
  return slides ? BristleMode{side * most_m, false} : BristleMode{deflection_m, true};
}

/// Runge-Kutta for one mass that is accelerated by `rate(position, velocity, time, drive)`.
template <typename Rate>
Plant::OneMass Plant::one_mass_after(double h, const Rate& rate) const noexcept {
  const double y = state_.position_m, v = state_.velocity_m_per_s, t = state_.time_s;
  const Drive d = drive(h);
  const double k1 = rate(y, v, t, d.start);
  const double v2 = v + 0.5 * h * k1;
  const double k2 = rate(y + 0.5 * h * v, v2, t + 0.5 * h, d.middle);
  const double v3 = v + 0.5 * h * k2;
  const double k3 = rate(y + 0.5 * h * v2, v3, t + 0.5 * h, d.middle);
  const double v4 = v + h * k3;
  const double k4 = rate(y + h * v3, v4, t + h, d.end);
  return {y + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), k1, d};
}

/// How long a mass at rest stays there, at most `duration_s`: just past the moment at which `moves(time,
/// drive)` turns true.
template <typename Moves>
double Plant::release_s(double duration_s, const Moves& moves) const noexcept {
  const auto moves_after = [&](double h) { return moves(state_.time_s + h, drive(h).end); };
  if (!terms_.varies_in_time || !moves_after(duration_s)) return duration_s;
  double low = 0, high = duration_s;
  for (int i = 0; i < 50 && high - low > kLeastAdvance_s; ++i) {
    const double middle = 0.5 * (low + high);
    (moves_after(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace cartwright
