#pragma once

#include <cmath>
#include <numbers>

#include "common/control/limit.hpp"

namespace cartwright {

struct PdGains {
  double kp_V_per_m = 0;
  double kd_V_s_per_m = 0;
  double derivative_filter_hz = 50;
  bool derivative_on_measurement = false;
};

/// Proportional-derivative law at tick k with period Ts, e = r - y:
///
///     ef += (1 - exp(-2 pi f Ts)) ((e - e_prev)/Ts - ef)          filtered derivative [m/s]
///     u   = clip(Kp e + Kd ef + d, +-limit)                       [V]
///
/// e_prev = e at the first tick. With the derivative on the measurement -y takes the place of e in it, so
/// that a step of the reference does not kick. No allocation, no exception.
class PdController {
 public:
  PdController(const PdGains& gains, double period_s, double voltage_limit_V)
      : voltage_limit_V_(voltage_limit_V) {
    set(gains, period_s);
  }

  void set(const PdGains& gains, double period_s) {
    gains_ = gains;
    period_s_ = period_s;
    smoothing_ = 1 - std::exp(-2 * std::numbers::pi * gains.derivative_filter_hz * period_s);
  }

  void reset() {
    first_ = true;
    filtered_m_per_s_ = 0;
  }

  double update(double reference_m, double measured_m, double added_V = 0) noexcept {
    const double error = reference_m - measured_m;
    const double source = gains_.derivative_on_measurement ? -measured_m : error;
    if (first_) previous_ = source;
    first_ = false;
    filtered_m_per_s_ += smoothing_ * ((source - previous_) / period_s_ - filtered_m_per_s_);
    previous_ = source;
    return clip(gains_.kp_V_per_m * error + gains_.kd_V_s_per_m * filtered_m_per_s_ + added_V,
                voltage_limit_V_);
  }

  const PdGains& gains() const { return gains_; }
  double filtered_derivative_m_per_s() const { return filtered_m_per_s_; }

 private:
  PdGains gains_;
  double period_s_ = 1e-3, voltage_limit_V_, smoothing_ = 0;
  double previous_ = 0, filtered_m_per_s_ = 0;
  bool first_ = true;
};

}  // namespace cartwright
