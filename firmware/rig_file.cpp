#include "firmware/rig_file.hpp"

#include <fmt/format.h>

#include <tuple>

#include "common/config/controller_toml.hpp"
#include "common/config/model_toml.hpp"
#include "common/config/toml_reader.hpp"
#include "common/files/files.hpp"
#include "firmware/rig_file_compensation.hpp"

namespace cartwright::firmware {
namespace {

namespace fs = std::filesystem;

Result<void> read_numbers(RigFile& out, const TomlReader& table) {
  const std::tuple<std::string_view, double*, double, double> numbers[] = {
      {"slew_limit_V_per_s", &out.slew_limit_V_per_s, 1, 1e9},
      {"travel_margin_m", &out.travel_margin_m, 0, 1},
      {"greatest_speed_m_per_s", &out.greatest_speed_m_per_s, 1e-3, 1e3},
      {"host_timeout_s", &out.host_timeout_s, 0.05, 600},
      {"encoder_stuck_V", &out.encoder_stuck_V, 0, 1e6},
      {"encoder_stuck_s", &out.encoder_stuck_s, 1e-3, 60},
      {"encoder_oldest_s", &out.encoder_oldest_s, 1e-4, 1},
      {"approach_kp_V_per_m", &out.approach_kp_V_per_m, 0, 1e6},
      {"approach_kd_V_s_per_m", &out.approach_kd_V_s_per_m, 0, 1e6},
      {"approach_speed_m_per_s", &out.approach_speed_m_per_s, 1e-3, 10},
  };
  for (const auto& [key, into, least, most] : numbers) {
    const auto value = table.number(key, *into, least, most);
    if (!value) return tl::unexpected(value.error());
    *into = *value;
  }
  const auto missed = table.number("most_missed_ticks", out.most_missed_ticks, 1, 1e6);
  if (!missed) return tl::unexpected(missed.error());
  out.most_missed_ticks = static_cast<std::uint32_t>(*missed);
  const auto port = table.number("port", out.port, 0, 65535);
  if (!port) return tl::unexpected(port.error());
  out.port = static_cast<int>(*port);
  const auto realtime = table.flag("require_realtime", out.require_realtime);
  if (!realtime) return tl::unexpected(realtime.error());
  out.require_realtime = *realtime;
  return {};
}

Result<void> read_words(RigFile& out, const TomlReader& table, const fs::path& directory) {
  const auto kind = table.required_text("kind", "\"simulated\"");
  if (!kind) return tl::unexpected(kind.error());
  out.kind = *kind;
  if (out.kind != "simulated") {
    return failure(
        fmt::format("{}: kind = \"{}\": this version drives a simulated cart only; write \"simulated\"",
                    table.where("kind"), out.kind));
  }
  const auto clock = table.text("clock", "real");
  if (!clock) return tl::unexpected(clock.error());
  if (*clock != "real" && *clock != "virtual") {
    return failure(fmt::format("{}: clock must be \"real\" or \"virtual\"", table.where("clock")));
  }
  out.virtual_time = *clock == "virtual";
  const auto listen = table.text("listen", out.listen);
  if (!listen) return tl::unexpected(listen.error());
  out.listen = *listen;
  const auto gains = table.text("gain_file", out.gain_file.string());
  if (!gains) return tl::unexpected(gains.error());
  out.gain_file = directory / *gains;
  return {};
}

Result<Model> read_cart_model(const TomlReader& root, const std::optional<TomlReader>& simulation,
                              std::string_view text, const fs::path& directory) {
  const bool named = simulation && simulation->has("model");
  if (named == root.has("model")) {
    return failure(
        fmt::format("{}: a simulated rig needs either model = \"FILE\" in [simulation] or a [model] table{}",
                    root.source(), named ? ", not both" : ""));
  }
  if (!named) return model_from_toml(text, root.source());
  const auto name = simulation->required_text("model", "a model file");
  if (!name) return tl::unexpected(name.error());
  const fs::path file = directory / *name;
  return read_file(file).and_then(
      [&](const std::string& model) { return model_from_toml(model, file.string()); });
}

Result<void> read_simulation(RigFile& out, const TomlReader& root, std::string_view text,
                             const fs::path& directory) {
  const auto simulation = root.table("simulation");
  if (!simulation) return tl::unexpected(simulation.error());
  const auto model = read_cart_model(root, *simulation, text, directory);
  if (!model) return tl::unexpected(model.error());
  out.model = *model;
  if (!*simulation) return {};
  const TomlReader& table = **simulation;
  const auto known = table.only({"model", "seed", "start_position_m", "end_stop_m"});
  if (!known) return known;
  const auto seed = table.number("seed", 1, 0, 4294967295.0);
  if (!seed) return tl::unexpected(seed.error());
  out.seed = static_cast<std::uint64_t>(*seed);
  const auto start = table.number("start_position_m", 0, out.rig.travel_m[0], out.rig.travel_m[1]);
  if (!start) return tl::unexpected(start.error());
  out.start_position_m = *start;
  const auto end_stop = table.number("end_stop_m", out.end_stop_m, 0, 10);
  if (!end_stop) return tl::unexpected(end_stop.error());
  out.end_stop_m = *end_stop;
  return {};
}

}  // namespace

Result<RigFile> rig_file_from_toml(std::string_view text, const fs::path& source) {
  const auto document = parse_toml(text, source.string());
  if (!document) return tl::unexpected(document.error());
  const TomlReader root(*document, source.string());
  const auto sections = root.only({"rig", "simulation", "model", "compensation"});
  if (!sections) return tl::unexpected(sections.error());
  RigFile out;
  const auto rig = rig_from_toml(root);
  if (!rig) return tl::unexpected(rig.error());
  out.rig = *rig;
  const auto section = root.table("rig");
  if (!section) return tl::unexpected(section.error());
  const TomlReader& table = **section;
  const auto known = table.only({"name",
                                 "sample_rate_hz",
                                 "encoder_resolution_m",
                                 "voltage_limit_V",
                                 "travel_m",
                                 "kind",
                                 "clock",
                                 "listen",
                                 "port",
                                 "gain_file",
                                 "require_realtime",
                                 "slew_limit_V_per_s",
                                 "travel_margin_m",
                                 "greatest_speed_m_per_s",
                                 "host_timeout_s",
                                 "most_missed_ticks",
                                 "encoder_stuck_V",
                                 "encoder_stuck_s",
                                 "encoder_oldest_s",
                                 "approach_kp_V_per_m",
                                 "approach_kd_V_s_per_m",
                                 "approach_speed_m_per_s"});
  if (!known) return tl::unexpected(known.error());
  if (out.rig.sample_rate_hz < 100 || out.rig.sample_rate_hz > 4000) {
    return failure(fmt::format("{}: sample_rate_hz = {} is outside [100, 4000]",
                               table.where("sample_rate_hz"), out.rig.sample_rate_hz));
  }
  if (!(out.rig.encoder_resolution_m > 0)) {
    return failure(
        fmt::format("{}: encoder_resolution_m must be greater than 0", table.where("encoder_resolution_m")));
  }
  const fs::path directory = source.parent_path();
  for (const auto& read :
       {read_words(out, table, directory), read_numbers(out, table),
        read_simulation(out, root, text, directory), read_compensation(out.settings, root, directory)}) {
    if (!read) return tl::unexpected(read.error());
  }
  if (2 * out.travel_margin_m >= out.rig.travel_m[1] - out.rig.travel_m[0]) {
    return failure(fmt::format("{}: travel_margin_m = {} leaves nothing of the travel",
                               table.where("travel_margin_m"), out.travel_margin_m));
  }
  return out;
}

Result<RigFile> read_rig_file(const fs::path& file) {
  return read_file(file).and_then([&](const std::string& text) { return rig_file_from_toml(text, file); });
}

}  // namespace cartwright::firmware
