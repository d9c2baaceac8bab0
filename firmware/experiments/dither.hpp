#pragma once

#include "firmware/experiments/demand.hpp"
#include "firmware/experiments/multisine.hpp"

namespace cartwright::firmware {

/// Adds a multisine voltage to a PD hold: broad-band excitation without leaving the place.
class Dither {
 public:
  Dither() = default;
  Dither(double position_m, const MultisineSetup& setup) : position_m_(position_m), shape_(setup) {}

  double start_m() const noexcept { return position_m_; }
  double duration_s() const noexcept { return shape_.duration_s(); }
  Demand at(double time_s, double /*measured_m*/) noexcept { return {position_m_, shape_.at(time_s)}; }

 private:
  double position_m_ = 0;
  Multisine shape_;
};

}  // namespace cartwright::firmware
