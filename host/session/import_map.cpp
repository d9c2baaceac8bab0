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

/// Which numbers a table `{ channel = "NAME", ... }` takes.
Result<ChannelSource> source_from_toml(const TomlReader& entry) {
  const auto name = entry.required_text("channel", "the channel's name in the file");
  const auto row = position(entry, "row");
  const auto pick = position(entry, "column");
  const auto cell_row = position(entry, "cell_row");
  const auto bits = position(entry, "signed_bits");
  if (!name) return tl::unexpected(name.error());
  for (const auto* value : {&row, &pick, &cell_row, &bits}) {
    if (!*value) return tl::unexpected(value->error());
  }
  if (*row && *pick) return failure(fmt::format("{}: give row or column, not both", entry.where("row")));
  if (*cell_row && entry.has("cell"))
    return failure(fmt::format("{}: give cell or cell_row, not both", entry.where("cell_row")));
  if (*bits && (**bits < 2 || **bits > 32))
    return failure(fmt::format("{}: signed_bits must lie within 2 and 32", entry.where("signed_bits")));
  ChannelSource source;
  source.from = {*name, std::nullopt, *row, *pick};
  if (*bits) source.signed_bits = static_cast<unsigned>(**bits);
  if (entry.has("cell")) {
    const auto cell = entry.numbers("cell", 2);
    if (!cell) return tl::unexpected(cell.error());
    if ((*cell)[0] < 1 || (*cell)[1] < 1) {
      return failure(fmt::format("{}: cell = [row, column] counts from 1", entry.where("cell")));
    }
    source.from.cell = {static_cast<std::size_t>((*cell)[0]), static_cast<std::size_t>((*cell)[1])};
  }
  if (*cell_row) {
    source.from.cell = {**cell_row, 0};
    source.every_cell = true;
  }
  return source;
}

/// A channel by its name alone, or as a table.
Result<ChannelSource> source_at(const TomlReader& parent, const std::string& key, std::string_view usage) {
  if (parent.raw()[key].is_string()) {
    ChannelSource source;
    source.from.variable = *parent.text(key, "");
    return source;
  }
  if (!parent.raw()[key].is_table())
    return failure(fmt::format("{}: {} must be \"NAME\" or {}", parent.where(key), key, usage));
  const auto table = parent.table(key);
  if (!table) return tl::unexpected(table.error());
  const auto known = (*table)->only({"channel", "row", "column", "cell", "cell_row", "signed_bits"});
  if (!known) return tl::unexpected(known.error());
  return source_from_toml(**table);
}

Result<ChannelMap> channel_from_toml(const TomlReader& channels, const std::string& column) {
  ChannelMap out;
  out.column = column;
  if (!is_identifier(column)) {
    return failure(fmt::format("{}: {} is no valid column name", channels.where(column), column));
  }
  if (!channels.raw()[column].is_table()) {
    const auto source = source_at(channels, column, "{ channel = \"NAME\", scale = 1.0, offset = 0.0 }");
    if (!source) return tl::unexpected(source.error());
    out.factors.push_back(*source);
    return out;
  }
  const auto table = channels.table(column);
  if (!table) return tl::unexpected(table.error());
  const TomlReader& entry = **table;
  const auto known =
      entry.only({"channel", "scale", "offset", "row", "column", "cell", "cell_row", "signed_bits", "times"});
  if (!known) return tl::unexpected(known.error());
  const auto source = source_from_toml(entry);
  if (!source) return tl::unexpected(source.error());
  out.factors.push_back(*source);
  if (entry.has("times")) {
    const auto times = source_at(entry, "times", "{ channel = \"NAME\", ... }");
    if (!times) return tl::unexpected(times.error());
    out.factors.push_back(*times);
  }
  const auto scale = entry.number("scale", 1, -kMost, kMost);
  const auto offset = entry.number("offset", 0, -kMost, kMost);
  for (const auto* value : {&scale, &offset}) {
    if (!*value) return tl::unexpected(value->error());
  }
  if (*scale == 0)
    return failure(fmt::format("{}: scale = 0 would leave nothing of the channel", entry.where("scale")));
  out.scale = *scale;
  out.offset = *offset;
  return out;
}

Result<void> recording_from_toml(const TomlReader& entry, ImportMap& map) {
  const auto only = entry.only({"experiment", "rows", "resample_hz", "cell_columns"});
  if (!only) return tl::unexpected(only.error());
  const auto experiment = entry.text("experiment", "");
  if (!experiment) return tl::unexpected(experiment.error());
  map.experiment = *experiment;
  const auto rows = entry.text("rows", "");
  if (!rows) return tl::unexpected(rows.error());
  map.rows = *rows;
  if (entry.has("resample_hz")) {
    const auto rate = entry.required_number("resample_hz", 1, 1e6);
    if (!rate) return tl::unexpected(rate.error());
    if (map.rate_given)
      return failure(fmt::format("{}: resample_hz sets the rate; leave sample_rate_hz out of [rig]",
                                 entry.where("resample_hz")));
    map.resample_hz = *rate;
  }
  const bool per_cell = std::any_of(map.channels.begin(), map.channels.end(), [](const ChannelMap& c) {
    return std::any_of(c.factors.begin(), c.factors.end(),
                       [](const ChannelSource& s) { return s.every_cell; });
  });
  if (per_cell != entry.has("cell_columns")) {
    return failure(fmt::format("{}: cell_row in [channels] and cell_columns in [recording] go together",
                               entry.where(per_cell ? "experiment" : "cell_columns")));
  }
  if (const toml::array* list = entry.raw()["cell_columns"].as_array()) {
    for (const toml::node& node : *list) {
      const auto value = node.value<std::int64_t>();
      if (!value || *value < 1)
        return failure(fmt::format("{}: cell_columns counts from 1", entry.where("cell_columns")));
      map.cell_columns.push_back(static_cast<std::size_t>(*value));
    }
  }
  if (per_cell && map.cell_columns.empty())
    return failure(
        fmt::format("{}: cell_columns must be a list like [2, 4, 6]", entry.where("cell_columns")));
  return {};
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
  if (const auto section = root.table("rig"); section && *section) {
    const auto only =
        (*section)->only({"name", "sample_rate_hz", "encoder_resolution_m", "voltage_limit_V", "travel_m"});
    if (!only) return tl::unexpected(only.error());
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
  static const toml::table none;
  const auto taken = recording_from_toml(*recording ? **recording : TomlReader(none, map.source), map);
  if (!taken) return tl::unexpected(taken.error());
  return map;
}

}  // namespace cartwright
