#include "host/design/tuning_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cartwright::design {
namespace {

Gains from_times(double kp, double integral_time_s, double derivative_time_s, bool integral) {
  return {kp, kp * derivative_time_s, integral ? kp / integral_time_s : 0};
}

/// The x > 0 at which a falling function has come down to `value`.
template <typename Falling>
double falls_to(Falling f, double value) {
  double low = 0, high = 1;
  while (f(high) > value) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > value ? low : high) = middle;
  }
  return high;
}

/// 1 - z of the critically damped step response at x = w0 t.
double remaining(double x) {
  return (1 + x) * std::exp(-x);
}

}  // namespace

std::optional<UltimatePoint> ultimate_point(const SimpleCart& cart) {
  const double beta = cart.gain_m_per_s2_V, c = cart.damping_per_s, dead = cart.dead_time_s;
  if (!(beta > 0) || !(c > 0) || !(dead > 0)) return std::nullopt;
  // atan(c/w) falls, w L rises: they meet once.
  const double w = falls_to([&](double x) { return std::atan2(c, x) - x * dead; }, 0);
  return UltimatePoint{w * std::hypot(w, c) / beta, 2 * std::numbers::pi / w};
}

Gains ziegler_nichols(const UltimatePoint& u, bool integral) {
  return from_times((integral ? 0.6 : 0.8) * u.gain_V_per_m, u.period_s / 2, u.period_s / 8, integral);
}

Gains tyreus_luyben(const UltimatePoint& u, bool integral) {
  return from_times(u.gain_V_per_m / 2.2, 2.2 * u.period_s, u.period_s / 6.3, integral);
}

Gains phase_margin_gains(const RelayFeature& f, double margin_rad, bool integral) {
  const double needed_V_per_m = 4 * std::hypot(f.h1_V, f.h2_V) / (std::numbers::pi * f.amplitude_m);
  const double lead_rad = std::max(0.0, margin_rad - std::atan2(f.h2_V, f.h1_V));
  const double kp = needed_V_per_m * std::cos(lead_rad);
  return {kp, needed_V_per_m * std::sin(lead_rad) / f.frequency_rad_per_s,
          integral ? kp * f.frequency_rad_per_s / 10 : 0};
}

Gains critically_damped(const SimpleCart& cart, double w, bool integral) {
  // (s + w)^2 (s + p) = s^3 + (c + beta Kd) s^2 + beta Kp s + beta Ki
  const double p = integral ? w / 5 : 0, beta = cart.gain_m_per_s2_V;
  return {(w * w + 2 * w * p) / beta, std::max(0.0, (2 * w + p - cart.damping_per_s) / beta),
          w * w * p / beta};
}

double natural_frequency_for(const Specification& spec, const Loop& loop, const StepTest& step,
                             const SimpleCart& cart) {
  if (const auto& settled_s = spec[Quantity::settling_time]) {
    return falls_to(remaining, spec.settling_band) / *settled_s;
  }
  if (const auto& rise_s = spec[Quantity::rise_time]) {
    return (falls_to(remaining, 0.1) - falls_to(remaining, 0.9)) / *rise_s;
  }
  if (const auto& bandwidth_hz = spec[Quantity::bandwidth]) {
    // |1/(1 + j x)^2| = 1/sqrt(2)
    return 2 * std::numbers::pi * *bandwidth_hz / std::sqrt(std::numbers::sqrt2 - 1);
  }
  return std::sqrt(cart.gain_m_per_s2_V * loop.voltage_limit_V / std::abs(step.step_m));
}

}  // namespace cartwright::design
