#include "host/design/step_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace cartwright::design {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// When a straight line from (t0, a) to (t1, b) passes `level`.
double passes_s(double t0, double a, double t1, double b, double level) {
  return a == b ? t1 : t0 + (t1 - t0) * (level - a) / (b - a);
}

double magnitude(std::span<const double> z, double turn_rad) {
  // exp(-j w t) by rotation; renewed every 256 ticks, so that rounding does not add up.
  constexpr std::size_t kRenew = 256;
  const std::complex<double> turn = std::polar(1.0, -turn_rad);
  std::complex<double> sum = 0, pointer = 1;
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    if (k % kRenew == 0) pointer = std::polar(1.0, -turn_rad * static_cast<double>(k));
    sum += (z[k + 1] - z[k]) * pointer;
    pointer = {pointer.real() * turn.real() - pointer.imag() * turn.imag(),
               pointer.real() * turn.imag() + pointer.imag() * turn.real()};
  }
  return std::abs(sum);
}

}  // namespace

void StepMeter::add(double time_s, double z, double command_V, double held_s) noexcept {
  if (first_) {
    first_ = false;
    last_time_s_ = time_s;
    last_z_ = z;
  }
  for (const auto& [level, passed] : {std::pair{0.1, &tenth_s_}, {0.9, &nine_tenths_s_}}) {
    if (*passed < 0 && z >= level) *passed = passes_s(last_time_s_, last_z_, time_s, z, level);
  }
  const bool outside = !(std::abs(z - 1) <= band_);
  if (outside_ && !outside)
    settled_s_ = passes_s(last_time_s_, last_z_, time_s, z, last_z_ < 1 ? 1 - band_ : 1 + band_);
  outside_ = outside;
  greatest_ = std::max(greatest_, z - 1);
  peak_V_ = std::max(peak_V_, std::abs(command_V));
  squares_V2_s_ += command_V * command_V * held_s;
  held_s_ += held_s;
  last_time_s_ = time_s;
  last_z_ = z;
}

StepMetrics StepMeter::metrics() const {
  StepMetrics m;
  m.settling_time_s = outside_ ? kInf : settled_s_;
  m.overshoot = greatest_;
  m.rise_time_s = nine_tenths_s_ < 0 ? kInf : nine_tenths_s_ - tenth_s_;
  m.rms_voltage_V = held_s_ > 0 ? std::sqrt(squares_V2_s_ / held_s_) : 0;
  m.peak_voltage_V = peak_V_;
  m.bandwidth_hz = std::numeric_limits<double>::quiet_NaN();
  m.final_error = last_z_ - 1;
  return m;
}

double bandwidth_hz(std::span<const double> z, double period_s) {
  const std::size_t count = z.size();
  if (count < 20) return std::numeric_limits<double>::quiet_NaN();
  const double travelled = z.back() - z.front();
  const double late = z.back() - z[count - 1 - count / 20];
  // Still moving in the last twentieth: the transform would be of a cut-off motion.
  if (!(std::abs(travelled) > 0.5) || std::abs(late) > 0.01 * std::abs(travelled)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double wanted = std::abs(travelled) / std::numbers::sqrt2;
  const auto above = [&](double f) { return magnitude(z, 2 * std::numbers::pi * f * period_s) > wanted; };
  // Scan upwards, finely enough for a resonance not to hide a dip: a twentieth more each time.
  double low = 0, high = 0.2 / (static_cast<double>(count) * period_s);
  while (above(high)) {
    low = high;
    high *= 1.05;
    if (high > 0.5 / period_s) return kInf;
  }
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (above(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace cartwright::design
