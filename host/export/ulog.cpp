#include "host/export/ulog.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "host/export/controller_fields.hpp"
#include "host/export/identifier.hpp"
#include "host/export/ulog_writer.hpp"
#include "host/session/gaps.hpp"

namespace cartwright {

Result<std::string> to_ulog(const Rig& rig, const Recording& recording) {
  const double origin_s = std::min(0.0, recording.t_s.front());
  const auto microseconds = [origin_s](double time_s) {
    return static_cast<std::uint64_t>(std::llround((time_s - origin_s) * 1e6));
  };
  constexpr double kLongest_s = 1e12;  // 1e18 microseconds still fit into 63 bits
  if (recording.t_s.back() - origin_s > kLongest_s) {
    return failure(fmt::format("{}: t_s reaches {} s, ULog counts microseconds up to {} s", recording.file,
                               recording.t_s.back(), kLongest_s));
  }

  UlogWriter log(microseconds(recording.t_s.front()));
  log.info("sys_name", "Cartwright");
  log.info("ver_sw", CARTWRIGHT_VERSION);
  log.info("recording", recording.file);
  if (!recording.experiment.empty()) log.info("experiment", recording.experiment);
  if (!rig.name.empty()) log.info("rig_name", rig.name);
  log.info("sample_rate_hz", rig.sample_rate_hz);
  log.info("encoder_resolution_m", rig.encoder_resolution_m);
  log.info("voltage_limit_V", rig.voltage_limit_V);
  log.info("time_of_timestamp_zero_s", origin_s);

  const ControllerFields gains = controller_fields(recording.controller);
  if (!gains.type.empty()) log.info("controller_type", gains.type);
  for (std::size_t i = 0; i < gains.names.size(); ++i) {
    log.parameter(gains.names[i], static_cast<float>(gains.values[i]));
  }

  const CsvTable table = to_table(recording);
  const auto formatted = log.format("tick", identifiers(table.names));
  if (!formatted) return failure(fmt::format("{}: {}", recording.file, formatted.error().message));
  if (!gains.names.empty()) {
    const auto gains_formatted = log.format("gains", gains.names);
    if (!gains_formatted) return tl::unexpected(gains_formatted.error());
  }

  const std::uint16_t ticks = log.subscribe("tick");
  const std::uint16_t gain_changes = gains.names.empty() ? ticks : log.subscribe("gains");
  const auto gaps = find_gaps(recording.t_s);
  auto gap = gaps.begin();
  std::vector<double> values(table.columns.size());
  for (std::size_t row = 0; row < recording.size(); ++row) {
    const std::uint64_t now_us = microseconds(recording.t_s[row]);
    if (gap != gaps.end() && gap->row == row) {
      log.dropout(gap->lost_s);
      log.warning(now_us, fmt::format("{} ticks lost between {} s and {} s", gap->lost_ticks, gap->from_s,
                                      gap->to_s));
      ++gap;
    }
    for (std::size_t column = 0; column < values.size(); ++column)
      values[column] = table.columns[column][row];
    log.data(ticks, now_us, values);
    const bool at_an_end = row == 0 || row + 1 == recording.size();
    if (at_an_end && !gains.names.empty()) log.data(gain_changes, now_us, gains.values);
  }
  return log.bytes();
}

}  // namespace cartwright
