#pragma once

#include "firmware/experiments/demand.hpp"

namespace cartwright::firmware {

/// Holds a position for a while.
class Hold {
 public:
  explicit Hold(double position_m = 0, double duration_s = 6)
      : position_m_(position_m), duration_s_(duration_s) {}

  double start_m() const noexcept { return position_m_; }
  double duration_s() const noexcept { return duration_s_; }
  Demand at(double /*time_s*/, double /*measured_m*/) noexcept { return {position_m_}; }

 private:
  double position_m_, duration_s_;
};

}  // namespace cartwright::firmware
