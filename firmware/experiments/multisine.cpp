#include "firmware/experiments/multisine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace cartwright::firmware {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kFadePart = 1.0 / 16;

double fade(double time_s, double duration_s) {
  const double part = std::min(time_s, duration_s - time_s) / (kFadePart * duration_s);
  if (part >= 1) return 1;
  return part <= 0 ? 0 : 0.5 * (1 - std::cos(std::numbers::pi * part));
}

}  // namespace

Multisine::Multisine(const MultisineSetup& setup) : duration_s_(setup.duration_s) {
  std::mt19937 random(setup.seed);
  const int wanted = std::clamp(setup.lines, 1, static_cast<int>(kMostLines));
  double last_multiple = 0;
  for (int i = 0; i < wanted; ++i) {
    const double part = wanted == 1 ? 0 : static_cast<double>(i) / (wanted - 1);
    const double even = setup.logarithmic ? setup.low_hz * std::pow(setup.high_hz / setup.low_hz, part)
                                          : setup.low_hz + (setup.high_hz - setup.low_hz) * part;
    // Lines that would fall on the same multiple move up to the next free one.
    const double multiple = std::max(std::round(even * setup.duration_s), last_multiple + 1);
    last_multiple = multiple;
    frequency_hz_[lines_] = multiple / setup.duration_s;
    phase_rad_[lines_] = kTwoPi * static_cast<double>(random()) / 4294967296.0;
    ++lines_;
  }
  double peak = 0;
  for (double t = 0; t < setup.duration_s; t += setup.period_s) {
    peak = std::max(peak, std::abs(fade(t, duration_s_) * sum(t)));
  }
  scale_ = peak > 0 ? setup.amplitude / peak : 0;
}

double Multisine::sum(double time_s) const noexcept {
  double total = 0;
  for (std::size_t i = 0; i < lines_; ++i)
    total += std::sin(kTwoPi * frequency_hz_[i] * time_s + phase_rad_[i]);
  return total;
}

double Multisine::at(double time_s) const noexcept {
  return scale_ * fade(time_s, duration_s_) * sum(time_s);
}

}  // namespace cartwright::firmware
