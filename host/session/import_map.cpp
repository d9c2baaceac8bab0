#include <fmt/format.h>

#include <algorithm>

#include "common/config/controller_toml.hpp"
#include "host/session/files.hpp"
#include "host/session/import.hpp"

namespace cartwright {
namespace {

constexpr double kMost = 1e12;

bool is_identifier(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

Result<std::optional<std::size_t>> position(const TomlReader& entry, std::string_view key) {
  if (!entry.has(key)) return std::optional<std::size_t>{};
  const auto value = entry.required_number(key, 1, 1e9);
  if (!value) return tl::unexpected(value.error());
  return std::optional(static_cast<std::size_t>(*value));
}

Result<ChannelMap> channel_from_toml(const TomlReader& channels, const std::string& column) {
  ChannelMap out;
  out.column = column;
  if (!is_identifier(column)) {
    return failure(fmt::format("{}: {} is no valid column name", channels.where(column), column));
  }
  if (channels.raw()[column].is_string()) {
    const auto name = channels.text(column, "");
    if (!name) return tl::unexpected(name.error());
    out.from.variable = *name;
    return out;
  }
  if (!channels.raw()[column].is_table()) {
    return failure(
        fmt::format("{}: {} must be \"NAME\" or {{ channel = \"NAME\", scale = 1.0, offset = 0.0 }}",
                    channels.where(column), column));
  }
  const auto table = channels.table(column);
  if (!table) return tl::unexpected(table.error());
  const TomlReader& entry = **table;
  const auto known = entry.only({"channel", "scale", "offset", "row", "column", "cell"});
  if (!known) return tl::unexpected(known.error());
  const auto name = entry.required_text("channel", "the channel's name in the file");
  const auto scale = entry.number("scale", 1, -kMost, kMost);
  const auto offset = entry.number("offset", 0, -kMost, kMost);
  const auto row = position(entry, "row");
  const auto pick = position(entry, "column");
  if (!name) return tl::unexpected(name.error());
  for (const auto* value : {&scale, &offset}) {
    if (!*value) return tl::unexpected(value->error());
  }
  for (const auto* value : {&row, &pick}) {
    if (!*value) return tl::unexpected(value->error());
  }
  if (*row && *pick) return failure(fmt::format("{}: give row or column, not both", entry.where("row")));
  if (*scale == 0)
    return failure(fmt::format("{}: scale = 0 would leave nothing of the channel", entry.where("scale")));
  out.from = {*name, std::nullopt, *row, *pick};
  if (entry.has("cell")) {
    const auto cell = entry.numbers("cell", 2);
    if (!cell) return tl::unexpected(cell.error());
    if ((*cell)[0] < 1 || (*cell)[1] < 1) {
      return failure(fmt::format("{}: cell = [row, column] counts from 1", entry.where("cell")));
    }
    out.from.cell = {static_cast<std::size_t>((*cell)[0]), static_cast<std::size_t>((*cell)[1])};
  }
  out.scale = *scale;
  out.offset = *offset;
  return out;
}

}  // namespace

Result<ImportMap> read_import_map(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  auto document = parse_toml(*text, file.string());
  if (!document) return tl::unexpected(document.error());
  ImportMap map;
  map.source = file.string();
  const TomlReader root(*document, map.source);
  const auto known = root.only({"channels", "rig", "controller", "recording"});
  if (!known) return tl::unexpected(known.error());

  const auto channels = root.table("channels");
  if (!channels) return tl::unexpected(channels.error());
  if (!*channels)
    return failure(fmt::format("{}: no [channels]; it says which channel is y_m, which u_V", map.source));
  for (const auto& [key, value] : (*channels)->raw()) {
    auto channel = channel_from_toml(**channels, std::string(key.str()));
    if (!channel) return tl::unexpected(channel.error());
    map.channels.push_back(std::move(*channel));
  }
  const auto maps = [&map](std::string_view name) {
    return std::any_of(map.channels.begin(), map.channels.end(),
                       [&](const ChannelMap& c) { return c.column == name; });
  };
  for (const std::string_view needed : {"y_m", "u_V"}) {
    if (!maps(needed)) return failure(fmt::format("{}: [channels] has no {}", map.source, needed));
  }

  // The rig's keys are all optional here; what is missing is put in only so that one reader serves both
  // files.
  if (!document->contains("rig")) document->insert("rig", toml::table{});
  toml::table* rig_table = document->get("rig")->as_table();
  if (rig_table != nullptr) {
    map.rate_given = rig_table->contains("sample_rate_hz");
    map.limit_given = rig_table->contains("voltage_limit_V");
    map.travel_given = rig_table->contains("travel_m");
    if (!map.rate_given) rig_table->insert("sample_rate_hz", Rig{}.sample_rate_hz);
  }
  const auto rig = rig_from_toml(root);
  if (!rig) return tl::unexpected(rig.error());
  map.rig = *rig;
  if (!map.rate_given && !maps("t_s")) {
    return failure(fmt::format(
        "{}: neither t_s in [channels] nor sample_rate_hz in [rig]: one must give the time", map.source));
  }
  const auto controller = controller_from_toml(root);
  if (!controller) return tl::unexpected(controller.error());
  map.controller = *controller;
  if (!std::holds_alternative<std::monostate>(map.controller)) {
    if (!maps("r_m")) return failure(fmt::format("{}: [controller] needs r_m in [channels]", map.source));
    if (!map.limit_given)
      return failure(fmt::format("{}: [controller] needs voltage_limit_V in [rig]", map.source));
  }
  const auto recording = root.table("recording");
  if (!recording) return tl::unexpected(recording.error());
  if (*recording) {
    const auto only = (*recording)->only({"experiment"});
    if (!only) return tl::unexpected(only.error());
    const auto experiment = (*recording)->text("experiment", "");
    if (!experiment) return tl::unexpected(experiment.error());
    map.experiment = *experiment;
  }
  return map;
}

}  // namespace cartwright
