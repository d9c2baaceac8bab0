#include "host/session/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/session/segments.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;

/// Limits that no cart on a rail reaches; beyond them a unit is wrong.
constexpr double kMostSpan_m = 50;
constexpr double kMostVoltage_V = 5000;
constexpr double kLeastRate_hz = 2, kMostRate_hz = 1e6;
/// How far the rate that time implies may lie from the one the rig gives.
constexpr double kRateTolerance = 0.1;

Result<CsvTable> read_mat(const fs::path& file, const ImportMap& map) {
  const auto mat = MatFile::open(file);
  if (!mat) return tl::unexpected(mat.error());
  CsvTable table;
  for (const ChannelMap& channel : map.channels) {
    auto values = mat->read(channel.from);
    if (!values) return tl::unexpected(values.error());
    table.names.push_back(channel.column);
    table.columns.push_back(std::move(*values));
  }
  return table;
}

Result<CsvTable> read_columns(const fs::path& file, const ImportMap& map) {
  const auto all = read_csv(file);
  if (!all) return tl::unexpected(all.error());
  CsvTable table;
  for (const ChannelMap& channel : map.channels) {
    const std::vector<double>* found = all->find(channel.from.variable);
    if (found == nullptr) {
      return failure(fmt::format("{}: no channel {}; it has {}", file.string(), channel.from.variable,
                                 fmt::join(all->names, ", ")));
    }
    table.names.push_back(channel.column);
    table.columns.push_back(*found);
  }
  return table;
}

double span(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Refuses numbers that cannot be metres, volts and seconds, and says which scale would be the usual mend.
Result<void> plausible(const Recording& recording, const ImportMap& map, const std::string& source) {
  const double rate_hz = 1 / median_period_s(recording.t_s);
  if (map.rate_given && std::abs(rate_hz / map.rig.sample_rate_hz - 1) > kRateTolerance) {
    return failure(
        fmt::format("{}: t_s as mapped in {} implies {:.6g} Hz, [rig] says sample_rate_hz = {:.6g}: check "
                    "the scale of t_s (milliseconds need scale = 1e-3)",
                    source, map.source, rate_hz, map.rig.sample_rate_hz));
  }
  if (rate_hz < kLeastRate_hz || rate_hz > kMostRate_hz) {
    return failure(
        fmt::format("{}: t_s as mapped in {} implies {:.6g} Hz, which no recording has: check the scale of "
                    "t_s (milliseconds need scale = 1e-3)",
                    source, map.source, rate_hz));
  }
  const double travelled_m = span(recording.y_m);
  const double most_m = map.travel_given ? 2 * (map.rig.travel_m[1] - map.rig.travel_m[0]) : kMostSpan_m;
  if (travelled_m > most_m) {
    return failure(
        fmt::format("{}: y_m as mapped in {} spans {:.4g} m, more than {:.4g} m: check its scale "
                    "(millimetres need scale = 1e-3)",
                    source, map.source, travelled_m, most_m));
  }
  if (travelled_m < map.rig.encoder_resolution_m) {
    return failure(
        fmt::format("{}: y_m as mapped in {} spans {:.4g} m, less than one count of {:.4g} m: check its "
                    "scale",
                    source, map.source, travelled_m, map.rig.encoder_resolution_m));
  }
  const double voltage_V = greatest(recording.u_V);
  const double most_V = map.limit_given ? 2 * map.rig.voltage_limit_V : kMostVoltage_V;
  if (voltage_V > most_V) {
    return failure(
        fmt::format("{}: u_V as mapped in {} reaches {:.4g} V, more than {:.4g} V: check its scale "
                    "(millivolts need scale = 1e-3)",
                    source, map.source, voltage_V, most_V));
  }
  return {};
}

}  // namespace

Result<Recording> import_recording(const fs::path& file, const ImportMap& map) {
  const std::string extension = file.extension().string();
  const bool matlab = extension == ".mat" || extension == ".MAT";
  auto table = matlab ? read_mat(file, map) : read_columns(file, map);
  if (!table) return tl::unexpected(table.error());
  for (std::size_t i = 0; i < table->columns.size(); ++i) {
    if (table->columns[i].size() != table->columns.front().size()) {
      return failure(fmt::format("{}: {} has {} values, {} has {}; all channels must be equally long",
                                 file.string(), table->names.front(), table->columns.front().size(),
                                 table->names[i], table->columns[i].size()));
    }
    for (double& value : table->columns[i]) value = map.channels[i].scale * value + map.channels[i].offset;
  }
  if (table->find("t_s") == nullptr) {
    std::vector<double> t_s(table->rows());
    for (std::size_t row = 0; row < t_s.size(); ++row)
      t_s[row] = static_cast<double>(row) / map.rig.sample_rate_hz;
    table->names.emplace_back("t_s");
    table->columns.push_back(std::move(t_s));
  }
  Recording recording;
  recording.file = file.stem().string() + ".csv";
  recording.experiment = map.experiment;
  recording.controller = map.controller;
  const auto taken = take_columns(recording, std::move(*table), file.string());
  if (!taken) return tl::unexpected(taken.error());
  const auto checked = plausible(recording, map, file.string());
  if (!checked) return tl::unexpected(checked.error());
  return recording;
}

Result<Session> import_session(std::span<const fs::path> files, const ImportMap& map) {
  Session session;
  session.rig = map.rig;
  std::set<std::string> names;
  double rate_hz = 0, voltage_V = 0, least_m = 0, most_m = 0;
  for (const fs::path& file : files) {
    auto recording = import_recording(file, map);
    if (!recording) return tl::unexpected(recording.error());
    if (!names.insert(recording->file).second) {
      return failure(fmt::format("{}: another file of that name would become {} too; rename one",
                                 file.string(), recording->file));
    }
    const double rate = 1 / median_period_s(recording->t_s);
    if (rate_hz > 0 && std::abs(rate / rate_hz - 1) > kRateTolerance) {
      return failure(
          fmt::format("{}: {:.6g} Hz, the files before have {:.6g} Hz; a session has one sample rate",
                      file.string(), rate, rate_hz));
    }
    const auto [least, most] = std::minmax_element(recording->y_m.begin(), recording->y_m.end());
    least_m = session.recordings.empty() ? *least : std::min(least_m, *least);
    most_m = session.recordings.empty() ? *most : std::max(most_m, *most);
    voltage_V = std::max(voltage_V, greatest(recording->u_V));
    if (rate_hz == 0) rate_hz = rate;
    session.recordings.push_back(std::move(*recording));
  }
  if (!map.rate_given) session.rig.sample_rate_hz = std::round(rate_hz * 1e3) / 1e3;
  if (!map.limit_given) session.rig.voltage_limit_V = voltage_V;
  if (!map.travel_given && most_m > least_m) session.rig.travel_m = {least_m, most_m};
  return session;
}

}  // namespace cartwright
