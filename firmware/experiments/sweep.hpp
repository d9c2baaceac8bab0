#pragma once

#include <cmath>

#include "firmware/experiments/demand.hpp"

namespace cartwright::firmware {

struct SweepSetup {
  double amplitude_m = 0.15;
  double slowest_m_per_s = 0.1, fastest_m_per_s = 0.3;
  int speeds = 2;
  double acceleration_m_per_s2 = 1;
};

/// Slow traverses from -A to +A and back, at each speed in turn. A traverse of length D = 2 A at speed v
/// accelerates at a, runs at v, and decelerates at a; it takes D/v + v/a and needs v^2/a <= D. Speeds are
/// even in the logarithm.
class Sweep {
 public:
  explicit Sweep(const SweepSetup& setup = {}) : setup_(setup) {}

  double start_m() const noexcept { return -setup_.amplitude_m; }

  double duration_s() const noexcept {
    double total = 0;
    for (int i = 0; i < setup_.speeds; ++i) total += 2 * leg_s(speed(i));
    return total;
  }

  /// Whether the fastest traverse reaches its speed.
  bool possible() const noexcept {
    const double v = std::fmax(setup_.slowest_m_per_s, setup_.fastest_m_per_s);
    return v * v / setup_.acceleration_m_per_s2 <= 2 * setup_.amplitude_m;
  }

  Demand at(double time_s, double /*measured_m*/) noexcept {
    for (int i = 0; i < setup_.speeds; ++i) {
      const double leg = leg_s(speed(i));
      if (time_s < leg) return {-setup_.amplitude_m + travelled(time_s, leg, speed(i))};
      time_s -= leg;
      if (time_s < leg) return {setup_.amplitude_m - travelled(time_s, leg, speed(i))};
      time_s -= leg;
    }
    return {-setup_.amplitude_m};
  }

 private:
  double speed(int i) const noexcept {
    if (setup_.speeds == 1) return setup_.slowest_m_per_s;
    const double part = static_cast<double>(i) / (setup_.speeds - 1);
    return setup_.slowest_m_per_s * std::pow(setup_.fastest_m_per_s / setup_.slowest_m_per_s, part);
  }
  double leg_s(double v) const noexcept {
    return 2 * setup_.amplitude_m / v + v / setup_.acceleration_m_per_s2;
  }
  double travelled(double t, double leg, double v) const noexcept {
    const double a = setup_.acceleration_m_per_s2, ramp_s = v / a;
    if (t < ramp_s) return 0.5 * a * t * t;
    if (t < leg - ramp_s) return v * (t - 0.5 * ramp_s);
    const double left_s = leg - t;
    return 2 * setup_.amplitude_m - 0.5 * a * left_s * left_s;
  }

  SweepSetup setup_;
};

}  // namespace cartwright::firmware
