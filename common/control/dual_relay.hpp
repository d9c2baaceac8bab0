#pragma once

#include "common/control/limit.hpp"

namespace cartwright {

struct DualRelayGains {
  double h1_V = 0;
  double h2_V = 0;
  double hysteresis_m = 0;
};

/// Dual relay at tick k with period Ts, e = r - y, I the running sum of e Ts including this tick:
///
///     u = clip(h1 sgn(e) + h2 sgn(I) + d, +-limit)                [V]          sgn(0) = +1
///
/// (Tan, Lee and others, Fig. 4.) With a hysteresis the first relay changes over only once e has passed zero
/// by that much; 0 is the plain relay. No allocation, no exception.
class DualRelayController {
 public:
  DualRelayController(const DualRelayGains& gains, double period_s, double voltage_limit_V)
      : gains_(gains), period_s_(period_s), voltage_limit_V_(voltage_limit_V) {}

  void reset() {
    integral_m_s_ = 0;
    first_ = true;
  }

  double update(double reference_m, double measured_m, double added_V = 0) noexcept {
    const double error = reference_m - measured_m;
    integral_m_s_ += error * period_s_;
    if (first_ || error >= gains_.hysteresis_m) {
      up_ = !first_ || error >= 0;
    } else if (error < -gains_.hysteresis_m) {
      up_ = false;
    }
    first_ = false;
    return clip(gains_.h1_V * (up_ ? 1 : -1) + gains_.h2_V * (integral_m_s_ >= 0 ? 1 : -1) + added_V,
                voltage_limit_V_);
  }

 private:
  DualRelayGains gains_;
  double period_s_, voltage_limit_V_;
  double integral_m_s_ = 0;
  bool up_ = true, first_ = true;
};

}  // namespace cartwright
