#pragma once

#include <array>
#include <string>
#include <variant>

#include "common/control/dual_relay.hpp"
#include "common/control/pid.hpp"

namespace cartwright {

/// What a recording must know of the rig it was made on: `[rig]` of session.toml.
struct Rig {
  std::string name = "cart";
  double sample_rate_hz = 1000;
  double encoder_resolution_m = 0;
  double voltage_limit_V = 12;
  std::array<double, 2> travel_m{-0.4, 0.4};

  double period_s() const { return 1 / sample_rate_hz; }
};

/// The control law a recording was made with; none for a foreign recording. PD and PID are kept apart: much
/// that holds for the first does not for the second.
using ControllerSpec = std::variant<std::monostate, PdGains, DualRelayGains, PidGains>;

}  // namespace cartwright
