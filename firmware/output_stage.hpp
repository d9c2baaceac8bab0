#pragma once

#include <algorithm>
#include <cmath>

#include "common/control/limit.hpp"
#include "common/wire/codes.hpp"

namespace cartwright::firmware {

/// The last step before the amplifier: finite check, limit, rate limit.
class OutputStage {
 public:
  struct Result {
    double voltage_V = 0;
    wire::Limited limited_by = wire::Limited::nothing;
    bool finite = true;
  };

  OutputStage(double limit_V, double slew_V_per_s) : limit_V_(limit_V), slew_V_per_s_(slew_V_per_s) {}

  /// What to put out for what the control law wants, `period_s` after the last output. A want that is no
  /// number gives zero volts at once.
  Result shape(double wanted_V, double period_s) noexcept {
    Result out;
    out.finite = std::isfinite(wanted_V);
    if (!out.finite) {
      last_V_ = 0;
      return out;
    }
    const double limited = clip(wanted_V, limit_V_);
    const double change = slew_V_per_s_ * period_s;
    out.voltage_V = std::clamp(limited, last_V_ - change, last_V_ + change);
    if (out.voltage_V != limited) {
      out.limited_by = wire::Limited::slew;
    } else if (std::abs(wanted_V) >= limit_V_) {
      out.limited_by = wire::Limited::voltage;
    }
    last_V_ = out.voltage_V;
    return out;
  }

  /// Zero volts at once, as after a fault or on disarming.
  void cut() noexcept { last_V_ = 0; }

 private:
  double limit_V_, slew_V_per_s_, last_V_ = 0;
};

}  // namespace cartwright::firmware
