#include "host/diagnose/show/diagnosis_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/config/interval_toml.hpp"
#include "common/config/model_toml.hpp"
#include "host/diagnose/judge/statement.hpp"

namespace cartwright {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double v : values) list.push_back(number(v));
  return list;
}

Json interval(const Estimate& e) {
  return {{"value", number(e.value)}, {"low", number(e.low)}, {"high", number(e.high)}};
}

Json where_json(const Where& where) {
  Json json = Json::object();
  for (const char* axis :
       {"time_s", "position_m", "velocity_m_per_s", "voltage_V", "frequency_hz", "after_reversal_m"}) {
    const auto found = where.find(axis);
    json[axis] = numbers(found == where.end() ? std::vector<double>{} : found->second);
  }
  return json;
}

Json names(const std::vector<Term>& list) {
  Json json = Json::array();
  for (const Term term : list) json.push_back(info(term).name);
  return json;
}

Json recordings_json(const Support& support) {
  Json list = Json::array();
  for (const RecordingSays& r : support.recordings)
    list.push_back(
        {{"file", r.file}, {"gain_nats", number(r.nats)}, {"standard_error_nats", number(r.standard_error)}});
  return list;
}

Json effect_json(const Effect& effect, const Model& model) {
  Json parameters = Json::object();
  if (effect.term == Term::external_disturbance) parameters["recording"] = model.disturbance_recording;
  for (const auto& [id, e] : effect.parameters) parameters[std::string(info(id).key)] = interval(e);
  Json bounds = Json::array();
  for (const Parameter id : effect.at_bound) bounds.push_back(info(id).key);
  return {{"name", info(effect.term).name},
          {"confidence", number(effect.confidence)},
          {"equivalent", names(effect.equivalent)},
          {"parameters", parameters},
          {"at_bound", bounds},
          {"share_of_excess_error_removed", number(effect.share_of_excess_error_removed)},
          {"gain_nats", number(effect.gain)},
          {"recordings", recordings_json(effect.support)},
          {"window_rmse_without_m", number(effect.support.windows_without_m)},
          {"where", where_json(effect.where)},
          {"statement", effect.statement}};
}

Json map_json(const AxisMap& map) {
  Json out{{"axis", map.axis},
           {"parity", map.parity},
           {"flat", map.flat()},
           {"share", number(map.share)},
           {"low", numbers(map.low)},
           {"high", numbers(map.high)},
           {"push_m_per_s2", numbers(map.push_m_per_s2)},
           {"band_m_per_s2", numbers(map.band_m_per_s2)}};
  if (!map.names.empty()) out["names"] = map.names;
  return out;
}

Json profile_json(const Profile& profile) {
  return {{"axis", profile.axis},
          {"flat", profile.flat()},
          {"share", number(profile.flat() ? 0 : profile.share)},
          {"at", numbers(profile.at)},
          {profile.axis == "input_lag_s" ? "correlation" : "gain_nats", numbers(profile.value)},
          {"band", number(profile.band)},
          {"flat_below", number(profile.bar)}};
}

Json location_json(const Location& location) {
  Json axes = Json::array();
  for (const AxisMap& map : location.axes) axes.push_back(map_json(map));
  Json profiles = Json::array();
  for (const Profile* profile : location.profiles()) profiles.push_back(profile_json(*profile));
  return {{"axes", axes},
          {"profiles", profiles},
          {"repeats",
           {{"correlation", number(location.repeat_correlation)},
            {"standard_errors", number(location.repeat_z)}}}};
}

Json errors_json(const Errors& e) {
  return {{"nominal", number(e.nominal)},
          {"refitted", number(e.refitted)},
          {"with_effects", number(e.with_effects)}};
}

Json unexplained_json(const std::optional<Unexplained>& left) {
  if (!left) return nullptr;
  return {{"share_left", number(left->share_left)},
          {"where", where_json(left->where)},
          {"axis", left->axis},
          {"missing_force", map_json(left->curve)},
          {"periods_m", numbers(left->periods_m)},
          {"closest", left->closest ? Json(info(*left->closest).name) : Json(nullptr)},
          {"why_refused", left->why_refused}};
}

Json drive_json(const std::optional<DriveBalance>& drive) {
  if (!drive) return nullptr;
  Json lines = Json::array();
  for (const DriveLine& line : drive->lines) {
    lines.push_back({{"period_m", interval(line.period_m)},
                     {"height_V", interval(line.height_V)},
                     {"gain_nats", number(line.gain)}});
  }
  return {{"lines", lines},
          {"rms_V", {{"friction", number(drive->missing_V)}, {"with_lines", number(drive->left_V)}}},
          {"unseen_quarters_rms_V",
           {{"friction", number(drive->unseen_missing_V)}, {"with_lines", number(drive->unseen_left_V)}}},
          {"line_over_time_behind_nats", number(drive->time_behind)}};
}

}  // namespace

std::string to_json(const Diagnosis& d) {
  Json json;
  json["verdict"] = name(d.verdict);
  json["effects"] = Json::array();
  for (const Effect& effect : d.effects) json["effects"].push_back(effect_json(effect, d.model));
  json["runner_up"] = Json::array();
  for (const RunnerUp& other : d.runner_up) {
    json["runner_up"].push_back({{"name", info(other.term).name},
                                 {"instead_of", info(other.instead_of).name},
                                 {"confidence", number(other.confidence)},
                                 {"score_behind_nats", number(other.score_behind)}});
  }
  json["parameters"] = Json::object();
  for (const NominalParameter& p : d.parameters) {
    json["parameters"][dotted_name(p.id)] = {{"nominal", number(p.nominal)},
                                             {"value", number(p.refitted.value)},
                                             {"low", number(p.refitted.low)},
                                             {"high", number(p.refitted.high)}};
  }
  json["fit"] = {{"window_rmse_m", errors_json(d.used)}, {"held_out", nullptr}};
  json["fit"]["window_rmse_m"]["noise_floor"] = number(d.noise_floor_m);
  json["closed_loop_rmse_m"] = {{"used", errors_json(d.used_closed_loop)}, {"held_out", nullptr}};
  if (!d.held_out_recordings.empty()) {
    Json held{{"recordings", d.held_out_recordings}};
    held.update(errors_json(d.held_out));
    json["fit"]["held_out"] = held;
    json["closed_loop_rmse_m"]["held_out"] = errors_json(d.held_out_closed_loop);
  }
  json["unexplained"] = unexplained_json(d.unexplained);
  json["next_experiment"] = nullptr;
  if (d.next_experiment) {
    json["next_experiment"] = {{"experiment", d.next_experiment->experiment},
                               {"separates", d.next_experiment->separates},
                               {"expected_nats", number(d.next_experiment->expected_nats)},
                               {"chance", number(d.next_experiment->chance)}};
  }
  json["location"] = {{"before", location_json(d.before)}, {"after", location_json(d.after)}};
  json["drive_of_held_speed"] = drive_json(d.drive);
  json["remarks"] = d.remarks;
  return json.dump(2) + "\n";
}

std::string missing_force_csv(const Unexplained& left) {
  std::string csv = fmt::format("{0}_low,{0}_high,push_m_per_s2,band_m_per_s2\n", left.axis);
  for (std::size_t i = 0; i < left.curve.low.size(); ++i) {
    csv += fmt::format("{},{},{},{}\n", left.curve.low[i], left.curve.high[i], left.curve.push_m_per_s2[i],
                       left.curve.band_m_per_s2[i]);
  }
  return csv;
}

std::string model_with_intervals(const Diagnosis& d) {
  std::vector<ParameterInterval> intervals;
  for (const NominalParameter& p : d.parameters) intervals.push_back({p.id, p.refitted.low, p.refitted.high});
  std::string flags;
  for (const Effect& effect : d.effects) {
    for (const auto& [id, e] : effect.parameters) intervals.push_back({id, e.low, e.high});
    for (const Parameter id : effect.at_bound)
      flags += fmt::format("\"{}\" = \"at bound\"\n", dotted_name(id));
    if (effect.equivalent.empty()) continue;
    flags += fmt::format("\"{}\" = \"not separable from {}\"\n", info(effect.term).name,
                         names_of(effect.equivalent));
  }
  if (!flags.empty()) flags.insert(0, "\n[flags]\n");
  return to_toml(d.model) + intervals_to_toml(intervals) + flags;
}

}  // namespace cartwright
