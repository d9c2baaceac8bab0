#include "firmware/session_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/config/controller_toml.hpp"
#include "common/files/files.hpp"

namespace cartwright::firmware {
namespace {

std::string to_csv(std::vector<LogRow> rows) {
  const double start_s = rows.front()[0];
  for (LogRow& row : rows) row[0] = since_s(row[0], start_s);
  std::vector<std::size_t> kept;
  std::vector<std::string_view> names;
  for (std::size_t column = 0; column < kLogColumns; ++column) {
    if (std::all_of(rows.begin(), rows.end(), [&](const LogRow& row) { return std::isnan(row[column]); }))
      continue;
    kept.push_back(column);
    names.push_back(kLogColumnNames[column]);
  }
  fmt::memory_buffer out;
  fmt::format_to(fmt::appender(out), "{}\n", fmt::join(names, ","));
  for (const LogRow& row : rows) {
    for (const std::size_t column : kept) {
      if (column > 0) out.push_back(',');
      if (!std::isnan(row[column])) fmt::format_to(fmt::appender(out), "{}", row[column]);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

ControllerSpec controller_of(const RecordingEntry& entry) {
  if (entry.law == wire::Law::pd && entry.pd.ki_V_per_m_s != 0) return entry.pd;
  if (entry.law == wire::Law::pd) return entry.pd.pd;
  if (entry.law == wire::Law::dual_relay) return entry.relay;
  return {};
}

}  // namespace

Result<void> write_session(const RigFile& rig, const Exchange& exchange,
                           const std::filesystem::path& directory) {
  const std::uint32_t count = exchange.status.read().recordings;
  std::string toml = rig_to_toml(rig.rig);
  std::vector<NamedText> files;
  for (std::uint32_t i = 0; i < count; ++i) {
    const RecordingEntry entry = exchange.recordings[i].read();
    const std::string name(entry.file.view());
    std::vector<LogRow> rows(entry.rows);
    if (entry.rows == 0 || exchange.log.copy(entry.first_row, rows) < entry.rows) {
      return failure(
          fmt::format("{}: {} rows, of which the log no longer holds the first; record less at a time", name,
                      entry.rows));
    }
    files.push_back({name, to_csv(std::move(rows))});
    toml +=
        fmt::format("\n[[recording]]\nfile = \"{}\"\nexperiment = \"{}\"\n", name, wire::name(entry.kind));
    toml += controller_to_toml(controller_of(entry));
    if (entry.repeat_of > 0) {
      toml +=
          fmt::format("repeat_of = \"{}\"\n", exchange.recordings[entry.repeat_of - 1U].read().file.view());
    }
  }
  files.push_back({"session.toml", toml});
  return write_files(directory, files);
}

}  // namespace cartwright::firmware
