#include "host/diagnose/diagnosis_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/config/interval_toml.hpp"
#include "common/config/model_toml.hpp"

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
          {"where", where_json(effect.where)},
          {"statement", effect.statement}};
}

Json map_json(const AxisMap& map) {
  return {{"axis", map.axis},
          {"parity", map.parity},
          {"flat", map.flat()},
          {"share", number(map.share)},
          {"low", numbers(map.low)},
          {"high", numbers(map.high)},
          {"push_m_per_s2", numbers(map.push_m_per_s2)},
          {"band_m_per_s2", numbers(map.band_m_per_s2)}};
}

Json location_json(const Location& location) {
  Json axes = Json::array();
  for (const AxisMap& map : location.axes) axes.push_back(map_json(map));
  return {
      {"axes", axes},
      {"line",
       {{"frequency_hz", number(location.line.frequency_hz)}, {"gain_nats", number(location.line.gain)}}},
      {"input_lag", {{"lag_s", number(location.lag_s)}, {"correlation", number(location.lag_correlation)}}},
      {"repeats",
       {{"correlation", number(location.repeat_correlation)},
        {"standard_errors", number(location.repeat_z)}}}};
}

Json unexplained_json(const std::optional<Unexplained>& left) {
  if (!left) return nullptr;
  return {{"share_left", number(left->share_left)},
          {"where", where_json(left->where)},
          {"axis", left->axis},
          {"missing_force", map_json(left->curve)},
          {"closest", left->closest ? Json(info(*left->closest).name) : Json(nullptr)},
          {"why_refused", left->why_refused}};
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
  json["fit"] = {{"window_rmse_m",
                  {{"nominal", number(d.used.nominal)},
                   {"refitted", number(d.used.refitted)},
                   {"with_effects", number(d.used.with_effects)},
                   {"noise_floor", number(d.noise_floor_m)}}}};
  if (d.held_out_recordings.empty()) {
    json["fit"]["held_out"] = nullptr;
  } else {
    json["fit"]["held_out"] = {{"recordings", d.held_out_recordings},
                               {"nominal", number(d.held_out.nominal)},
                               {"refitted", number(d.held_out.refitted)},
                               {"with_effects", number(d.held_out.with_effects)}};
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
  json["remarks"] = d.remarks;
  return json.dump(2) + "\n";
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
    std::vector<std::string_view> others;
    for (const Term term : effect.equivalent) others.push_back(info(term).name);
    flags +=
        fmt::format("\"{}\" = \"not separable from {}\"\n", info(effect.term).name, fmt::join(others, ", "));
  }
  if (!flags.empty()) flags.insert(0, "\n[flags]\n");
  return to_toml(d.model) + intervals_to_toml(intervals) + flags;
}

}  // namespace cartwright
