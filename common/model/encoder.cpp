#include "common/model/encoder.hpp"

#include <cmath>
#include <numbers>

namespace cartwright {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014), as a uniform number in [0, 1).
double uniform(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

}  // namespace

Encoder::Encoder(const Model& model, double resolution_m, std::uint64_t seed)
    : resolution_m_(resolution_m), random_(seed) {
  const bool eccentric = model.has(Term::encoder_eccentricity);
  amplitude_m_ = eccentric ? model[Parameter::eccentricity_amplitude] : 0;
  wavenumber_rad_per_m_ = eccentric ? 2 * std::numbers::pi / model[Parameter::eccentricity_period] : 0;
  phase_rad_ = model[Parameter::eccentricity_phase];
  const bool misses = model.has(Term::encoder_missed_counts);
  burst_m_ = misses ? model[Parameter::missed_burst] * resolution_m : 0;
  rate_per_s_ = misses ? model[Parameter::missed_rate] : 0;
  speed_m_per_s_ = model[Parameter::missed_speed];
}

double Encoder::read(double position_m, double velocity_m_per_s, double elapsed_s) noexcept {
  if (rate_per_s_ > 0 && std::abs(velocity_m_per_s) > speed_m_per_s_ &&
      uniform(random_) < -std::expm1(-rate_per_s_ * elapsed_s)) {
    offset_m_ -= std::copysign(burst_m_, velocity_m_per_s);
  }
  const double y = seen(position_m);
  if (resolution_m_ <= 0) return y;
  return resolution_m_ * std::round(y / resolution_m_);
}

double Encoder::seen(double position_m) const noexcept {
  double y = position_m + offset_m_;
  if (amplitude_m_ != 0) y += amplitude_m_ * std::sin(wavenumber_rad_per_m_ * position_m + phase_rad_);
  return y;
}

}  // namespace cartwright
