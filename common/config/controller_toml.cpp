#include "common/config/controller_toml.hpp"

#include <fmt/format.h>

#include "common/config/toml_text.hpp"

namespace cartwright {
namespace {

/// A key of the rig with another unit at its end, such as encoder_resolution_mm, is refused: passed over it
/// would leave the rig another than its file says. Keys of other programs may stand there.
Result<void> refuse_other_units(const TomlReader& rig) {
  constexpr std::string_view kKeys[] = {"sample_rate_hz", "encoder_resolution_m", "voltage_limit_V",
                                        "travel_m"};
  for (const auto& [node_key, node] : rig.raw()) {
    const std::string_view key = node_key.str();
    const auto same_quantity = [key](std::string_view known) {
      return key != known && key.substr(0, key.rfind('_')) == known.substr(0, known.rfind('_'));
    };
    for (const std::string_view known : kKeys) {
      if (same_quantity(known))
        return failure(fmt::format("{}: {} must be given as {}", rig.where(key), key, known));
    }
  }
  return {};
}

}  // namespace

Result<Rig> rig_from_toml(const TomlReader& root) {
  const auto table = root.table("rig");
  if (!table) return tl::unexpected(table.error());
  if (!*table) return failure(fmt::format("{}: no [rig] table", root.source()));
  const TomlReader& entry = **table;
  if (const auto units = refuse_other_units(entry); !units) return tl::unexpected(units.error());
  Rig rig;
  const auto name = entry.text("name", rig.name);
  if (!name) return tl::unexpected(name.error());
  rig.name = *name;
  const std::tuple<std::string_view, double*, double, double, bool> numbers[] = {
      {"sample_rate_hz", &rig.sample_rate_hz, 1e-3, 1e7, true},
      {"encoder_resolution_m", &rig.encoder_resolution_m, 0, 1e3, false},
      {"voltage_limit_V", &rig.voltage_limit_V, 0, 1e6, false},
  };
  for (const auto& [key, into, least, most, required] : numbers) {
    const auto value =
        required ? entry.required_number(key, least, most) : entry.number(key, *into, least, most);
    if (!value) return tl::unexpected(value.error());
    *into = *value;
  }
  if (entry.has("travel_m")) {
    const auto travel = entry.numbers("travel_m", 2);
    if (!travel) return tl::unexpected(travel.error());
    if (!((*travel)[0] < (*travel)[1])) {
      return failure(fmt::format("{}: travel_m must be [least, greatest]", entry.where("travel_m")));
    }
    rig.travel_m = {(*travel)[0], (*travel)[1]};
  }
  return rig;
}

std::string rig_to_toml(const Rig& rig) {
  return fmt::format(
      "[rig]\nname = {}\nsample_rate_hz = {}\nencoder_resolution_m = {}\nvoltage_limit_V = {}\n"
      "travel_m = [{}, {}]\n",
      toml_text(rig.name), rig.sample_rate_hz, rig.encoder_resolution_m, rig.voltage_limit_V, rig.travel_m[0],
      rig.travel_m[1]);
}

Result<ControllerSpec> controller_from_toml(const TomlReader& entry) {
  const auto table = entry.table("controller");
  if (!table) return tl::unexpected(table.error());
  if (!*table) return ControllerSpec{};
  const TomlReader& spec = **table;
  const auto type = spec.required_text("type", "\"pd\", \"pid\" or \"dual_relay\"");
  if (!type) return tl::unexpected(type.error());
  constexpr double kMost = 1e9;
  const bool pid = *type == "pid";
  if (*type == "pd" || pid) {
    const auto known =
        pid ? spec.only({"type", "kp_V_per_m", "ki_V_per_m_s", "kd_V_s_per_m", "derivative_filter_hz",
                         "derivative_on"})
            : spec.only({"type", "kp_V_per_m", "kd_V_s_per_m", "derivative_filter_hz", "derivative_on"});
    if (!known) return tl::unexpected(known.error());
    const auto ki = pid ? spec.required_number("ki_V_per_m_s", -kMost, kMost) : Result<double>(0);
    const auto kp = spec.required_number("kp_V_per_m", -kMost, kMost);
    const auto kd = spec.number("kd_V_s_per_m", 0, -kMost, kMost);
    const auto filter = spec.number("derivative_filter_hz", PdGains{}.derivative_filter_hz, 0, kMost);
    const auto on = spec.text("derivative_on", "error");
    for (const auto* value : {&kp, &ki, &kd, &filter}) {
      if (!*value) return tl::unexpected(value->error());
    }
    if (!on) return tl::unexpected(on.error());
    if (*on != "error" && *on != "measurement") {
      return failure(
          fmt::format("{}: derivative_on must be \"error\" or \"measurement\"", spec.where("derivative_on")));
    }
    const PdGains pd{*kp, *kd, *filter, *on == "measurement"};
    if (pid) return PidGains{pd, *ki};
    return pd;
  }
  if (*type == "dual_relay") {
    const auto known = spec.only({"type", "h1_V", "h2_V", "hysteresis_m"});
    if (!known) return tl::unexpected(known.error());
    const auto h1 = spec.required_number("h1_V", -kMost, kMost);
    const auto h2 = spec.required_number("h2_V", -kMost, kMost);
    const auto hysteresis = spec.number("hysteresis_m", 0, 0, kMost);
    for (const auto* value : {&h1, &h2, &hysteresis}) {
      if (!*value) return tl::unexpected(value->error());
    }
    return DualRelayGains{*h1, *h2, *hysteresis};
  }
  return failure(fmt::format("{}: controller type \"{}\" is unknown; it is \"pd\", \"pid\" or \"dual_relay\"",
                             spec.where("type"), *type));
}

std::string controller_to_toml(const ControllerSpec& controller) {
  const auto* pid = std::get_if<PidGains>(&controller);
  if (const auto* pd = pid ? &pid->pd : std::get_if<PdGains>(&controller)) {
    return fmt::format(
        "controller = {{ type = \"{}\", kp_V_per_m = {}, {}kd_V_s_per_m = {}, derivative_filter_hz = {}{} "
        "}}\n",
        pid ? "pid" : "pd", pd->kp_V_per_m, pid ? fmt::format("ki_V_per_m_s = {}, ", pid->ki_V_per_m_s) : "",
        pd->kd_V_s_per_m, pd->derivative_filter_hz,
        pd->derivative_on_measurement ? ", derivative_on = \"measurement\"" : "");
  }
  if (const auto* relay = std::get_if<DualRelayGains>(&controller)) {
    return fmt::format(
        "controller = {{ type = \"dual_relay\", h1_V = {}, h2_V = {}{} }}\n", relay->h1_V, relay->h2_V,
        relay->hysteresis_m > 0 ? fmt::format(", hysteresis_m = {}", relay->hysteresis_m) : "");
  }
  return {};
}

}  // namespace cartwright
