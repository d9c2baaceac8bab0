#include "host/session/session.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "common/config/controller_toml.hpp"
#include "common/config/toml_reader.hpp"
#include "common/config/toml_text.hpp"
#include "host/session/files.hpp"
#include "host/session/rate.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;

Result<Recording> read_entry(const TomlReader& entry) {
  Recording recording;
  const auto file = entry.required_text("file", "the recording's CSV");
  if (!file) return tl::unexpected(file.error());
  recording.file = *file;
  if (fs::path(recording.file).has_parent_path()) {
    return failure(
        fmt::format("{}: file = \"{}\" must lie beside session.toml", entry.where(), recording.file));
  }
  const auto experiment = entry.text("experiment", "");
  if (!experiment) return tl::unexpected(experiment.error());
  recording.experiment = *experiment;
  const auto repeat_of = entry.text("repeat_of", "");
  if (!repeat_of) return tl::unexpected(repeat_of.error());
  recording.repeat_of = *repeat_of;
  const auto controller = controller_from_toml(entry);
  if (!controller) return tl::unexpected(controller.error());
  recording.controller = *controller;
  return recording;
}

/// More than any jitter of the median step, less than any mistaken rate.
constexpr double kMostRateError = 0.2;

}  // namespace

Result<void> take_columns(Recording& recording, CsvTable table, const std::string& source) {
  const auto take = [&](std::string_view name, std::vector<double>& into, bool required) -> Result<void> {
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      if (table.names[i] != name) continue;
      into = std::move(table.columns[i]);
      table.names[i].clear();
      for (std::size_t row = 0; row < into.size(); ++row) {
        if (!std::isfinite(into[row])) {
          return failure(fmt::format("{}:{}: {} is {}, a finite number is needed", source, row + 2, name,
                                     std::isnan(into[row]) ? "missing" : "infinite"));
        }
      }
      return {};
    }
    if (const auto text = table.texts.find(name); text != table.texts.end()) return failure(text->second);
    if (!required) return {};
    return failure(
        fmt::format("{}:1: no column {}; t_s, y_m and u_V are required, and r_m where a controller is given",
                    source, name));
  };
  const std::tuple<std::string_view, std::vector<double>*, bool> wanted[] = {
      {"t_s", &recording.t_s, true},  {"y_m", &recording.y_m, true},
      {"u_V", &recording.u_V, true},  {"r_m", &recording.r_m, recording.has_controller()},
      {"d_V", &recording.d_V, false},
  };
  for (const auto& [name, into, required] : wanted) {
    const Result<void> taken = take(name, *into, required);
    if (!taken) return taken;
  }
  if (recording.size() < 2) {
    return failure(fmt::format("{}: {} rows; a recording needs at least 2", source, recording.size()));
  }
  for (std::size_t row = 1; row < recording.size(); ++row) {
    if (!(recording.t_s[row] > recording.t_s[row - 1])) {
      return failure(fmt::format("{}:{}: t_s goes from {} to {}; time must increase strictly", source,
                                 row + 2, recording.t_s[row - 1], recording.t_s[row]));
    }
  }
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (!table.names[i].empty()) recording.other_columns.emplace(table.names[i], std::move(table.columns[i]));
  }
  return {};
}

Result<Session> read_session(const fs::path& directory) {
  const fs::path file = directory / "session.toml";
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto document = parse_toml(*text, file.string());
  if (!document) return tl::unexpected(document.error());
  const TomlReader root(*document, file.string());

  Session session;
  const auto rig = rig_from_toml(root);
  if (!rig) return tl::unexpected(rig.error());
  session.rig = *rig;

  const auto entries = root.tables("recording");
  if (!entries) return tl::unexpected(entries.error());
  if (entries->empty())
    return failure(fmt::format("{}: no [[recording]]; a session needs at least one", file.string()));
  std::set<std::string> seen;
  for (const TomlReader& entry : *entries) {
    auto recording = read_entry(entry);
    if (!recording) return tl::unexpected(recording.error());
    if (!seen.insert(recording->file).second) {
      return failure(fmt::format("{}: {} is listed twice", entry.where(), recording->file));
    }
    auto table = read_csv(directory / recording->file);
    if (!table) return tl::unexpected(table.error());
    const auto taken = take_columns(*recording, std::move(*table), (directory / recording->file).string());
    if (!taken) return tl::unexpected(taken.error());
    // A control law runs at sample_rate_hz: on rows of another rate it would be another law.
    if (recording->has_controller()) {
      const auto rate =
          check_rate(*recording, session.rig, kMostRateError, (directory / recording->file).string());
      if (!rate) return tl::unexpected(rate.error());
    }
    session.recordings.push_back(std::move(*recording));
  }
  for (const Recording& recording : session.recordings) {
    if (!recording.repeat_of.empty() && !seen.contains(recording.repeat_of)) {
      return failure(fmt::format("{}: repeat_of = \"{}\" names no recording of this session", file.string(),
                                 recording.repeat_of));
    }
  }
  return session;
}

CsvTable to_table(const Recording& recording) {
  CsvTable table;
  const auto add = [&table](std::string name, const std::vector<double>& column) {
    if (column.empty()) return;
    table.names.push_back(std::move(name));
    table.columns.push_back(column);
  };
  add("t_s", recording.t_s);
  add("r_m", recording.r_m);
  add("y_m", recording.y_m);
  add("u_V", recording.u_V);
  add("d_V", recording.d_V);
  for (const auto& [name, column] : recording.other_columns) add(name, column);
  return table;
}

Result<void> write_session(const Session& session, const fs::path& directory) {
  std::vector<NamedText> files;
  std::string text = rig_to_toml(session.rig);
  for (const Recording& recording : session.recordings) {
    files.push_back({recording.file, to_csv(to_table(recording))});
    text += fmt::format("\n[[recording]]\nfile = {}\n", toml_text(recording.file));
    if (!recording.experiment.empty())
      text += fmt::format("experiment = {}\n", toml_text(recording.experiment));
    text += controller_to_toml(recording.controller);
    if (!recording.repeat_of.empty()) text += fmt::format("repeat_of = {}\n", toml_text(recording.repeat_of));
  }
  files.push_back({"session.toml", std::move(text)});
  return write_files(directory, files);
}

std::size_t Session::without_law() const {
  return static_cast<std::size_t>(std::count_if(recordings.begin(), recordings.end(),
                                                [](const Recording& r) { return !r.has_controller(); }));
}

}  // namespace cartwright
