#pragma once

#include "firmware/experiments/demand.hpp"
#include "firmware/experiments/multisine.hpp"

namespace cartwright::firmware {

/// Follows a multisine reference; a sine is one with a single line.
class Track {
 public:
  Track() = default;
  explicit Track(const MultisineSetup& setup) : shape_(setup) {}

  double start_m() const noexcept { return 0; }
  double duration_s() const noexcept { return shape_.duration_s(); }
  Demand at(double time_s, double /*measured_m*/) noexcept { return {shape_.at(time_s)}; }

 private:
  Multisine shape_;
};

}  // namespace cartwright::firmware
