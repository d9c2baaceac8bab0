#pragma once

#include "common/control/pd.hpp"

namespace cartwright {

struct PidGains {
  PdGains pd{};
  double ki_V_per_m_s = 0;
};

/// Proportional-integral-derivative law at tick k with period Ts: the PD law (pd.hpp) with the integral as an
/// added voltage,
///
///     I += e Ts                                                   running sum of the error [m s]
///     u  = clip(Kp e + Kd ef + Ki I + d, +-limit)                 [V]
///
/// The sum includes this tick, as in the dual relay. It stands still at ticks at which the limit acts and the
/// error would drive the command further beyond it (conditional integration), so that a saturated step does
/// not wind it up; where something after the law limits, as the controller's output stage does, that limit is
/// told as `windup_limit_V`. With Ki = 0 the law is the PD law exactly. No allocation, no exception.
class PidController {
 public:
  PidController(const PidGains& gains, double period_s, double voltage_limit_V)
      : PidController(gains, period_s, voltage_limit_V, voltage_limit_V) {}
  PidController(const PidGains& gains, double period_s, double voltage_limit_V, double windup_limit_V)
      : pd_(gains.pd, period_s, voltage_limit_V),
        ki_V_per_m_s_(gains.ki_V_per_m_s),
        period_s_(period_s),
        windup_limit_V_(windup_limit_V) {}

  /// Other gains from the next tick on; what was filtered stays, and what was integrated unless Ki is now
  /// zero.
  void set(const PidGains& gains, double period_s) {
    pd_.set(gains.pd, period_s);
    ki_V_per_m_s_ = gains.ki_V_per_m_s;
    if (ki_V_per_m_s_ == 0) integral_m_s_ = 0;
    period_s_ = period_s;
  }

  void reset() {
    pd_.reset();
    integral_m_s_ = 0;
  }

  double update(double reference_m, double measured_m, double added_V = 0) noexcept {
    if (ki_V_per_m_s_ == 0) return pd_.update(reference_m, measured_m, added_V);
    const double grows_m_s = (reference_m - measured_m) * period_s_;
    const double drive_V = ki_V_per_m_s_ * (integral_m_s_ + grows_m_s);
    const double command_V = pd_.update(reference_m, measured_m, added_V + drive_V);
    const double pushes_V = ki_V_per_m_s_ * grows_m_s;
    const bool beyond =
        (command_V >= windup_limit_V_ && pushes_V > 0) || (command_V <= -windup_limit_V_ && pushes_V < 0);
    if (!beyond) integral_m_s_ += grows_m_s;
    return command_V;
  }

  double integral_m_s() const { return integral_m_s_; }

 private:
  PdController pd_;
  double ki_V_per_m_s_, period_s_, windup_limit_V_;
  double integral_m_s_ = 0;
};

}  // namespace cartwright
