#pragma once

#include <string>
#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// A control law as names and numbers, for formats that hold nothing else. Names are those of session.toml; a
/// choice is 0 or 1. Empty where a recording has no controller.
struct ControllerFields {
  std::string type;
  std::vector<std::string> names;
  std::vector<double> values;
};

inline ControllerFields controller_fields(const ControllerSpec& controller) {
  if (const auto* pd = std::get_if<PdGains>(&controller)) {
    return {"pd",
            {"kp_V_per_m", "kd_V_s_per_m", "derivative_filter_hz", "derivative_on_measurement"},
            {pd->kp_V_per_m, pd->kd_V_s_per_m, pd->derivative_filter_hz,
             pd->derivative_on_measurement ? 1.0 : 0.0}};
  }
  if (const auto* pid = std::get_if<PidGains>(&controller)) {
    ControllerFields fields = controller_fields(pid->pd);
    fields.type = "pid";
    fields.names.emplace_back("ki_V_per_m_s");
    fields.values.push_back(pid->ki_V_per_m_s);
    return fields;
  }
  if (const auto* relay = std::get_if<DualRelayGains>(&controller)) {
    return {"dual_relay", {"h1_V", "h2_V", "hysteresis_m"}, {relay->h1_V, relay->h2_V, relay->hysteresis_m}};
  }
  return {};
}

}  // namespace cartwright
