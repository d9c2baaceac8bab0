#pragma once

#include <filesystem>
#include <string>

#include "common/control/pid.hpp"
#include "common/result.hpp"

namespace cartwright::device {

/// A gain file is a controller as in session.toml, in a table of its own:
///
///     [controller]
///     type = "pd"
///     kp_V_per_m = 60
///     kd_V_s_per_m = 0.5
///     derivative_filter_hz = 50
///     derivative_on = "error"
///
/// With type = "pid" there is ki_V_per_m_s too. Every number must be within the range that the controller
/// takes (register map, staged_*).
Result<PidGains> gains_from_toml(std::string_view text, const std::string& source);
Result<PidGains> read_gains(const std::filesystem::path& file);
std::string gains_to_toml(const PidGains& gains);

}  // namespace cartwright::device
