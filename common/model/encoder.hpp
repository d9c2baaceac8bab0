#pragma once

#include <cstdint>

#include "common/model/model.hpp"

namespace cartwright {

/// What the encoder says of where the cart is:  y = q round((x + a sin(2 pi x/period + phase))/q) - lost
/// counts. Eccentricity and missed counts come from the model; the resolution q belongs to the rig. A
/// resolution of zero measures without rounding. Bursts are drawn from a generator of its own, so that a seed
/// repeats a recording.
class Encoder {
 public:
  Encoder(const Model& model, double resolution_m, std::uint64_t seed = 1);

  /// Reading at the cart's true position; speed and the time since the last reading decide on missed counts.
  double read(double position_m, double velocity_m_per_s, double elapsed_s) noexcept;

  /// What it would read if it neither rounded nor lost counts now.
  double seen(double position_m) const noexcept;

  double offset_m() const { return offset_m_; }

 private:
  double resolution_m_;
  double amplitude_m_, wavenumber_rad_per_m_, phase_rad_;
  double burst_m_, rate_per_s_, speed_m_per_s_;
  double offset_m_ = 0;
  std::uint64_t random_;
};

}  // namespace cartwright
