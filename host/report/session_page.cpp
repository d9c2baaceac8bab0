#include "host/report/session_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cartwright::report {
namespace {

/// A step between rows this many periods long or longer is a gap.
constexpr double kGapPeriods = 1.5;

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values);
  for (double& value : out) value *= factor;
  return out;
}

bool all_zero(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
}

}  // namespace

std::string describe(const ControllerSpec& controller) {
  if (const auto* pid = std::get_if<PidGains>(&controller)) {
    return fmt::format("PID, {:.4g} V/m, {:.4g} V/(m s), {:.4g} V s/m", pid->pd.kp_V_per_m, pid->ki_V_per_m_s,
                       pid->pd.kd_V_s_per_m);
  }
  if (const auto* pd = std::get_if<PdGains>(&controller)) {
    return fmt::format("PD, {:.4g} V/m, {:.4g} V s/m", pd->kp_V_per_m, pd->kd_V_s_per_m);
  }
  if (const auto* relay = std::get_if<DualRelayGains>(&controller)) {
    return fmt::format("dual relay, {:.4g} V, {:.4g} V", relay->h1_V, relay->h2_V);
  }
  return "none recorded";
}

std::string describe_fully(const ControllerSpec& controller) {
  std::string out = describe(controller);
  const auto* pid = std::get_if<PidGains>(&controller);
  if (const auto* pd = pid ? &pid->pd : std::get_if<PdGains>(&controller)) {
    out += fmt::format(", derivative of the {} filtered at {:.4g} Hz",
                       pd->derivative_on_measurement ? "measurement" : "error", pd->derivative_filter_hz);
  }
  if (const auto* relay = std::get_if<DualRelayGains>(&controller); relay && relay->hysteresis_m > 0) {
    out += fmt::format(", hysteresis {:.4g} mm", 1e3 * relay->hysteresis_m);
  }
  return out;
}

std::string describe_times(const Recording& recording, double sample_rate_hz) {
  if (recording.size() < 2) return "one row";
  double longest_s = 0;
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < recording.size(); ++i) {
    const double step_s = recording.t_s[i] - recording.t_s[i - 1];
    longest_s = std::max(longest_s, step_s);
    if (step_s >= kGapPeriods / sample_rate_hz) ++gaps;
  }
  if (gaps == 0) return "even";
  return fmt::format("{} gap{}, longest {:.1f} ms", gaps, gaps == 1 ? "" : "s", 1e3 * longest_s);
}

Table recordings_table(const Session& session) {
  Table table;
  table.columns = {{"Recording"},     {"Experiment"},       {"Controller"}, {"Rows"}, {"Length", "s"},
                   {"Least y", "mm"}, {"Greatest y", "mm"}, {"Rms u", "V"}, {"Times"}};
  for (const Recording& recording : session.recordings) {
    const auto [least, greatest] = std::minmax_element(recording.y_m.begin(), recording.y_m.end());
    double square = 0;
    for (const double u : recording.u_V) square += u * u;
    Cell times{describe_times(recording, session.rig.sample_rate_hz)};
    if (times.text != "even") times.mark(Tone::attention);
    table.row({recording.file, recording.experiment, describe(recording.controller),
               Cell::integer(recording.size()), Cell::number(recording.t_s.back() - recording.t_s.front(), 3),
               Cell::number(1e3 * *least), Cell::number(1e3 * *greatest),
               Cell::number(std::sqrt(square / static_cast<double>(recording.size())), 3), times});
  }
  return table;
}

std::vector<Plot> recording_plots(const Recording& recording, const std::vector<Overlay>& overlays) {
  Plot position;
  position.title = recording.file;
  position.x = {"", "s"};
  position.y = {"position", "mm"};
  position.height_px = 260;
  position.linked = recording.file;
  if (!recording.r_m.empty()) {
    position.add({.name = "reference",
                  .x = recording.t_s,
                  .y = scaled(recording.r_m, 1e3),
                  .mark = Mark::step,
                  .colour = Colour::reference,
                  .dashed = true});
  }
  position.add(
      {.name = "measured", .x = recording.t_s, .y = scaled(recording.y_m, 1e3), .colour = Colour::measured});
  Plot voltage;
  voltage.x = {"time", "s"};
  voltage.y = {"voltage", "V"};
  voltage.height_px = 170;
  voltage.linked = recording.file;
  voltage.add({.name = "command",
               .x = recording.t_s,
               .y = recording.u_V,
               .mark = Mark::step,
               .colour = Colour::measured});
  if (!recording.d_V.empty() && !all_zero(recording.d_V)) {
    voltage.add({.name = "added after the law",
                 .x = recording.t_s,
                 .y = recording.d_V,
                 .mark = Mark::step,
                 .colour = Colour::fourth,
                 .shown = false});
  }
  Plot error;
  error.x = {"", "s"};
  error.y = {"measured \u2212 predicted", "mm"};
  error.height_px = 150;
  error.linked = recording.file;
  for (const Overlay& overlay : overlays) {
    position.add(
        {.name = overlay.name, .x = overlay.t_s, .y = scaled(overlay.y_m, 1e3), .colour = overlay.colour});
    if (!overlay.u_V.empty()) {
      voltage.add({.name = overlay.name,
                   .x = overlay.t_s,
                   .y = overlay.u_V,
                   .mark = Mark::step,
                   .colour = overlay.colour});
    }
    if (overlay.y_m.size() == recording.size()) {
      std::vector<double> difference(recording.size());
      for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] = 1e3 * (recording.y_m[i] - overlay.y_m[i]);
      error.add(
          {.name = overlay.name, .x = recording.t_s, .y = std::move(difference), .colour = overlay.colour});
    }
  }
  if (error.series.empty()) return {position, voltage};
  return {position, error, voltage};
}

}  // namespace cartwright::report
