#pragma once

#include "host/session/session.hpp"

namespace cartwright {

/// A recording's own control law run on other readings: PD, PID or dual relay with the recorded reference and
/// added voltage, or the recorded voltage where no law is known. Refers to the recording: keep it.
class ControlLaw {
 public:
  ControlLaw(const Rig& rig, const Recording& recording);

  /// The command [V] for one row's reading; call once a row, in order.
  double command_V(std::size_t row, double reading_m);

 private:
  const Recording& recording_;
  std::variant<std::monostate, PdController, DualRelayController, PidController> law_;
};

}  // namespace cartwright
