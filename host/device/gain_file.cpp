#include "host/device/gain_file.hpp"

#include <fmt/format.h>

#include "common/config/controller_toml.hpp"
#include "common/config/toml_reader.hpp"
#include "common/files/files.hpp"
#include "common/wire/register_map.hpp"

namespace cartwright::device {

Result<PidGains> gains_from_toml(std::string_view text, const std::string& source) {
  const auto document = parse_toml(text, source);
  if (!document) return tl::unexpected(document.error());
  const TomlReader root(*document, source);
  if (const auto known = root.only({"controller"}); !known) return tl::unexpected(known.error());
  const auto controller = controller_from_toml(root);
  if (!controller) return tl::unexpected(controller.error());
  if (std::holds_alternative<std::monostate>(*controller)) {
    return failure(
        fmt::format("{}: no [controller] table with type = \"pd\" or \"pid\" and the gains", source));
  }
  PidGains gains;
  if (const auto* pd = std::get_if<PdGains>(&*controller)) {
    gains.pd = *pd;
  } else if (const auto* pid = std::get_if<PidGains>(&*controller)) {
    gains = *pid;
  } else {
    return failure(
        fmt::format("{}: the gain store holds PD and PID gains; type must be \"pd\" or \"pid\"", source));
  }
  const auto table = root.table("controller");
  const std::tuple<std::string_view, double, wire::Id> bounds[] = {
      {"kp_V_per_m", gains.pd.kp_V_per_m, wire::Id::staged_kp_V_per_m},
      {"kd_V_s_per_m", gains.pd.kd_V_s_per_m, wire::Id::staged_kd_V_s_per_m},
      {"derivative_filter_hz", gains.pd.derivative_filter_hz, wire::Id::staged_filter_hz},
      {"ki_V_per_m_s", gains.ki_V_per_m_s, wire::Id::staged_ki_V_per_m_s},
  };
  for (const auto& [key, value, id] : bounds) {
    const wire::Register& what = wire::info(id);
    if (value >= what.least && value <= what.most) continue;
    return failure(fmt::format("{}: {} = {} is outside [{}, {}], what the controller takes",
                               (*table)->where(key), key, value, what.least, what.most));
  }
  return gains;
}

Result<PidGains> read_gains(const std::filesystem::path& file) {
  return read_file(file).and_then(
      [&](const std::string& text) { return gains_from_toml(text, file.string()); });
}

std::string gains_to_toml(const PidGains& gains) {
  const bool pid = gains.ki_V_per_m_s != 0;
  return fmt::format(
      "[controller]\ntype = \"{}\"\nkp_V_per_m = {}\n{}kd_V_s_per_m = {}\nderivative_filter_hz = {}\n"
      "derivative_on = \"{}\"\n",
      pid ? "pid" : "pd", gains.pd.kp_V_per_m,
      pid ? fmt::format("ki_V_per_m_s = {}\n", gains.ki_V_per_m_s) : std::string(), gains.pd.kd_V_s_per_m,
      gains.pd.derivative_filter_hz, gains.pd.derivative_on_measurement ? "measurement" : "error");
}

}  // namespace cartwright::device
