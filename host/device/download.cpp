#include "host/device/download.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "common/log/record.hpp"
#include "host/device/log_reader.hpp"

namespace cartwright::device {
namespace {

using wire::Id;

ControllerSpec gains_of(const RegisterBlock& block) {
  const PdGains pd{block.value(Id::recording_kp_V_per_m), block.value(Id::recording_kd_V_s_per_m),
                   block.value(Id::recording_filter_hz), block.flag(Id::recording_derivative_on_measurement)};
  const double ki = block.value(Id::recording_ki_V_per_m_s);
  if (ki != 0) return PidGains{pd, ki};
  return pd;
}

Answer<RecordingInfo> describe(Controller& controller, std::size_t index) {
  if (const auto selected = controller.write({{Id::recording_select, static_cast<double>(index)}});
      !selected) {
    return tl::unexpected(selected.error());
  }
  const auto block = controller.read(Id::recording_file, Id::recording_ki_V_per_m_s);
  if (!block) return tl::unexpected(block.error());
  RecordingInfo info;
  info.file = block->text(Id::recording_file);
  info.experiment = wire::name(block->code<wire::ExperimentKind>(Id::recording_experiment));
  info.outcome = block->code<wire::Outcome>(Id::recording_outcome);
  info.first_row = block->integer<std::uint64_t>(Id::recording_first_row);
  info.rows = block->integer<std::uint64_t>(Id::recording_rows);
  info.lost_rows = block->integer<std::uint64_t>(Id::recording_lost_rows);
  info.repeat_of = block->integer<unsigned>(Id::recording_repeat_of);
  switch (block->code<wire::Law>(Id::recording_law)) {
    case wire::Law::pd:
      info.controller = gains_of(*block);
      break;
    case wire::Law::dual_relay:
      info.controller = DualRelayGains{block->value(Id::recording_h1_V), block->value(Id::recording_h2_V),
                                       block->value(Id::recording_hysteresis_m)};
      break;
    case wire::Law::none:
      break;
  }
  return info;
}

std::vector<std::string> split_names(const std::string& schema) {
  std::vector<std::string> names;
  for (std::size_t start = 0; start <= schema.size();) {
    const auto end = std::min(schema.find(',', start), schema.size());
    names.push_back(schema.substr(start, end - start));
    start = end + 1;
  }
  return names;
}

Answer<Rig> read_rig(Controller& controller) {
  const auto block = controller.read(Id::map_version, Id::most_missed_ticks);
  if (!block) return tl::unexpected(block.error());
  Rig rig;
  rig.name = block->text(Id::rig_name);
  rig.sample_rate_hz = block->value(Id::rate_hz);
  rig.encoder_resolution_m = block->value(Id::encoder_resolution_m);
  rig.voltage_limit_V = block->value(Id::voltage_limit_V);
  rig.travel_m = {block->value(Id::travel_low_m), block->value(Id::travel_high_m)};
  return rig;
}

std::string unique_file(const std::string& file, std::set<std::string>& taken) {
  std::string unique = file;
  for (int copy = 2; !taken.insert(unique).second; ++copy) {
    unique = fmt::format("{}_{}.csv", std::filesystem::path(file).stem().string(), copy);
  }
  return unique;
}

struct Rows {
  CsvTable table;
  std::uint64_t gone_before = 0;  ///< rows overwritten before the first one here
};

/// The rows of one recording as columns; rows the ring has overwritten are missing.
Answer<Rows> fetch_rows(LogReader& log, const RecordingInfo& info, const std::vector<std::string>& names,
                        const std::function<void(std::uint64_t)>& fetched) {
  Rows result;
  CsvTable& table = result.table;
  table.names = names;
  table.columns.resize(names.size());
  const std::uint64_t end = info.first_row + info.rows;
  for (std::uint64_t row = info.first_row; row < end;) {
    const auto page = log.page(row, static_cast<std::size_t>(end - row));
    if (!page) return tl::unexpected(page.error());
    if (page->rows == 0 || page->first_row >= end) break;
    const std::size_t rows =
        static_cast<std::size_t>(std::min<std::uint64_t>(page->rows, end - page->first_row));
    for (std::size_t i = 0; i < rows * names.size(); ++i)
      table.columns[i % names.size()].push_back(page->numbers[i]);
    row = page->first_row + rows;
    fetched(row - info.first_row);
  }
  return result;
}

void drop_empty_columns(CsvTable& table) {
  for (std::size_t i = table.names.size(); i-- > 0;) {
    const auto& column = table.columns[i];
    if (!std::all_of(column.begin(), column.end(), [](double value) { return std::isnan(value); })) continue;
    table.names.erase(table.names.begin() + static_cast<std::ptrdiff_t>(i));
    table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Time from the recording's first tick. If that row is gone, from where it was: whole periods before the
/// first row left.
void start_at_zero(CsvTable& table, std::uint64_t rows_gone, double period_s) {
  const auto time = std::find(table.names.begin(), table.names.end(), "t_s");
  if (time == table.names.end() || table.rows() == 0) return;
  auto& column = table.columns[static_cast<std::size_t>(time - table.names.begin())];
  const double start_s = column.front() - static_cast<double>(rows_gone) * period_s;
  for (double& value : column) value = since_s(value, start_s);
}

}  // namespace

Answer<std::size_t> recording_count(Controller& controller) {
  const auto block = controller.read(Id::recording_count);
  if (!block) return tl::unexpected(block.error());
  return block->integer<std::size_t>(Id::recording_count);
}

Answer<Download> download(Controller& controller, Range range, const Progress& progress) {
  Download result;
  const auto rig = read_rig(controller);
  if (!rig) return tl::unexpected(rig.error());
  result.session.rig = *rig;
  const auto schema = controller.read(Id::log_schema);
  if (!schema) return tl::unexpected(schema.error());
  const auto names = split_names(schema->text(Id::log_schema));

  std::vector<RecordingInfo> list;
  std::uint64_t rows = 0, done = 0;
  for (std::size_t index = range.first; index < range.last; ++index) {
    const auto info = describe(controller, index);
    if (!info) return tl::unexpected(info.error());
    if (info->outcome == wire::Outcome::running) {
      return trouble(Cause::refused, fmt::format("{} is still being recorded; wait, or stop it", info->file));
    }
    rows += info->rows;
    list.push_back(*info);
  }

  LogReader log(controller, names.size());
  std::set<std::string> taken;
  std::vector<std::string> file_of(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const RecordingInfo& info = list[i];
    auto fetched_rows = fetch_rows(log, info, names, [&](std::uint64_t fetched) {
      if (progress) progress(static_cast<double>(done + fetched) / static_cast<double>(rows));
    });
    if (!fetched_rows) return tl::unexpected(fetched_rows.error());
    CsvTable& table = fetched_rows->table;
    done += info.rows;
    const std::uint64_t gone = info.rows - table.rows();
    if (table.rows() < 2) {
      result.losses.push_back(
          gone == 0
              ? fmt::format("{}: fewer than 2 rows were recorded; left out", info.file)
              : fmt::format("{}: all but {} of {} rows were overwritten before they were fetched; left out",
                            info.file, table.rows(), info.rows));
      continue;
    }
    if (gone > 0) {
      result.losses.push_back(fmt::format("{}: {} of {} rows were overwritten before they were fetched",
                                          info.file, gone, info.rows));
    }
    if (info.lost_rows > gone) {
      result.losses.push_back(
          fmt::format("{}: {} ticks were missed while recording", info.file, info.lost_rows - gone));
    }
    start_at_zero(table, fetched_rows->gone_before, rig->period_s());
    drop_empty_columns(table);
    Recording recording;
    recording.file = unique_file(info.file, taken);
    recording.experiment = info.experiment;
    recording.controller = info.controller;
    if (const auto columns = take_columns(recording, std::move(table), recording.file); !columns) {
      return trouble(Cause::incompatible, columns.error().message);
    }
    file_of[i] = recording.file;
    if (info.repeat_of > range.first && info.repeat_of <= range.first + i) {
      recording.repeat_of = file_of[info.repeat_of - 1 - range.first];
    }
    result.session.recordings.push_back(std::move(recording));
  }
  return result;
}

}  // namespace cartwright::device
