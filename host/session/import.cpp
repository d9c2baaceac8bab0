#include "host/session/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>

#include "host/session/even_rows.hpp"
#include "host/session/json_rows.hpp"
#include "host/session/rate.hpp"
#include "host/session/segments.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;

/// Limits that no cart on a rail reaches; beyond them a unit is wrong.
constexpr double kMostSpan_m = 50;
constexpr double kMostVoltage_V = 5000;
constexpr double kLeastRate_hz = 2, kMostRate_hz = 1e6;

/// Where a line of the map is read from: gives the numbers of one channel.
using ChannelReader = std::function<Result<std::vector<double>>(const ChannelSource&)>;

Result<ChannelReader> open_channels(const fs::path& file, const ImportMap& map,
                                    std::optional<std::size_t> cell_column) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".mat") {
    const auto mat = MatFile::open(file);
    if (!mat) return tl::unexpected(mat.error());
    return [mat = *mat, cell_column](const ChannelSource& source) {
      MatSelection from = source.from;
      if (source.every_cell && cell_column) from.cell->second = *cell_column;
      return mat.read(from);
    };
  }
  auto all = extension == ".json" ? read_json_rows(file, map.rows) : read_csv(file);
  if (!all) return tl::unexpected(all.error());
  return [table = std::move(*all),
          name = file.string()](const ChannelSource& source) -> Result<std::vector<double>> {
    const auto values = table.required(source.from.variable, name, "channel");
    if (!values) return tl::unexpected(values.error());
    return **values;
  };
}

/// A two's complement number of `bits` bits that was stored unsigned, put right.
Result<void> make_signed(std::vector<double>& values, unsigned bits, const std::string& channel) {
  const double modulus = std::ldexp(1.0, static_cast<int>(bits));
  for (double& value : values) {
    if (value < 0 || value >= modulus || value != std::floor(value)) {
      return failure(fmt::format("{} holds {}, which is no unsigned {} bit number; leave out signed_bits",
                                 channel, value, bits));
    }
    if (value >= 0.5 * modulus) value -= modulus;
  }
  return {};
}

Result<std::vector<double>> read_line(const ChannelMap& line, const ChannelReader& read,
                                      const std::string& file) {
  std::vector<double> out;
  for (const ChannelSource& source : line.factors) {
    auto values = read(source);
    if (!values) return values;
    if (source.signed_bits) {
      const auto done = make_signed(*values, *source.signed_bits, source.from.variable);
      if (!done) return failure(fmt::format("{}: {}", file, done.error().message));
    }
    if (out.empty()) {
      out = std::move(*values);
      continue;
    }
    if (values->size() != out.size()) {
      return failure(fmt::format("{}: {} has {} values, {} has {}; what is multiplied must be equally long",
                                 file, line.factors.front().from.variable, out.size(), source.from.variable,
                                 values->size()));
    }
    for (std::size_t row = 0; row < out.size(); ++row) out[row] *= (*values)[row];
  }
  for (double& value : out) value = line.scale * value + line.offset;
  return out;
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
  if (map.rate_given && !same_rate(rate_hz, map.rig.sample_rate_hz)) {
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

Result<Recording> import_recording(const fs::path& file, const ImportMap& map,
                                   std::optional<std::size_t> cell_column) {
  const auto read = open_channels(file, map, cell_column);
  if (!read) return tl::unexpected(read.error());
  CsvTable table;
  for (const ChannelMap& line : map.channels) {
    auto values = read_line(line, *read, file.string());
    if (!values) return tl::unexpected(values.error());
    if (!table.columns.empty() && values->size() != table.rows()) {
      return failure(fmt::format("{}: {} has {} values, {} has {}; all channels must be equally long",
                                 file.string(), table.names.front(), table.rows(), line.column,
                                 values->size()));
    }
    table.names.push_back(line.column);
    table.columns.push_back(std::move(*values));
  }
  if (table.find("t_s") == nullptr) {
    std::vector<double> t_s(table.rows());
    for (std::size_t row = 0; row < t_s.size(); ++row)
      t_s[row] = static_cast<double>(row) / map.rig.sample_rate_hz;
    table.names.emplace_back("t_s");
    table.columns.push_back(std::move(t_s));
  }
  Recording recording;
  recording.file = file.stem().string() + (cell_column ? fmt::format("_{}", *cell_column) : "") + ".csv";
  recording.experiment = map.experiment;
  recording.controller = map.controller;
  const auto taken = take_columns(recording, std::move(table), file.string());
  if (!taken) return tl::unexpected(taken.error());
  const auto checked = plausible(recording, map, file.string());
  if (!checked) return tl::unexpected(checked.error());
  return map.resample_hz ? even_rows(recording, *map.resample_hz) : recording;
}

Result<Session> import_session(std::span<const fs::path> files, const ImportMap& map) {
  Session session;
  session.rig = map.rig;
  std::set<std::string> names;
  double rate_hz = 0, voltage_V = 0, least_m = 0, most_m = 0;
  std::vector<std::pair<fs::path, std::optional<std::size_t>>> sources;
  for (const fs::path& file : files) {
    if (map.cell_columns.empty()) sources.emplace_back(file, std::nullopt);
    for (const std::size_t column : map.cell_columns) sources.emplace_back(file, column);
  }
  for (const auto& [file, cell_column] : sources) {
    auto recording = import_recording(file, map, cell_column);
    if (!recording) return tl::unexpected(recording.error());
    if (!names.insert(recording->file).second) {
      return failure(fmt::format("{}: another file of that name would become {} too; rename one",
                                 file.string(), recording->file));
    }
    const double rate = 1 / median_period_s(recording->t_s);
    if (rate_hz > 0 && !same_rate(rate, rate_hz)) {
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
