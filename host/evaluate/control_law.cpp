#include "host/evaluate/control_law.hpp"

namespace cartwright {

ControlLaw::ControlLaw(const Rig& rig, const Recording& recording) : recording_(recording) {
  if (const auto* pd = std::get_if<PdGains>(&recording.controller)) {
    law_.emplace<PdController>(*pd, rig.period_s(), rig.voltage_limit_V);
  } else if (const auto* pid = std::get_if<PidGains>(&recording.controller)) {
    law_.emplace<PidController>(*pid, rig.period_s(), rig.voltage_limit_V);
  } else if (const auto* relay = std::get_if<DualRelayGains>(&recording.controller)) {
    law_.emplace<DualRelayController>(*relay, rig.period_s(), rig.voltage_limit_V);
  }
}

double ControlLaw::command_V(std::size_t row, double reading_m) {
  const auto update = [&](auto& law) {
    return law.update(recording_.r_m[row], reading_m, recording_.added_V(row));
  };
  if (auto* pd = std::get_if<PdController>(&law_)) return update(*pd);
  if (auto* pid = std::get_if<PidController>(&law_)) return update(*pid);
  if (auto* relay = std::get_if<DualRelayController>(&law_)) return update(*relay);
  return recording_.u_V[row];
}

}  // namespace cartwright
