#pragma once

#include <filesystem>
#include <string>

#include "common/control/pd.hpp"
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
/// Every number must be within the range that the controller takes (register map, staged_*).
Result<PdGains> gains_from_toml(std::string_view text, const std::string& source);
Result<PdGains> read_gains(const std::filesystem::path& file);
std::string gains_to_toml(const PdGains& gains);

}  // namespace cartwright::device
