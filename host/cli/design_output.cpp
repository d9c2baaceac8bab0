#include "host/cli/design_output.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/cli/json.hpp"
#include "host/design/gain_line.hpp"

namespace cartwright::cli {
namespace {

using namespace design;
using nlohmann::ordered_json;

ordered_json gains_json(const DesignTask& task, const Gains& gains) {
  ordered_json out = {{"kp_V_per_m", gains.kp_V_per_m}, {"kd_V_s_per_m", gains.kd_V_s_per_m}};
  if (task.integral) out["ki_V_per_m_s"] = gains.ki_V_per_m_s;
  if (!task.trials.loop.ideal) {
    out["derivative_filter_hz"] = task.trials.loop.derivative_filter_hz;
    out["derivative_on"] = task.trials.loop.derivative_on_measurement ? "measurement" : "error";
  }
  return out;
}

std::string asked(const QuantityInfo& q, double limit) {
  return fmt::format("{} {:.4g}", q.at_least ? ">=" : "<=", limit * q.shown_per_si);
}

std::string shown(double value, const QuantityInfo& q) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return q.id == Quantity::settling_time ? "never" : "none";
  return fmt::format("{:.4g}", value * q.shown_per_si);
}

std::string gains_text(const DesignTask& task, const Gains& g) {
  std::string text = fmt::format("Kp = {:.4g} V/m, Kd = {:.4g} V s/m", g.kp_V_per_m, g.kd_V_s_per_m);
  if (task.integral) text += fmt::format(", Ki = {:.4g} V/(m s)", g.ki_V_per_m_s);
  return text;
}

/// With Kp fixed: the stretches of Kd that the model itself meets the specification with.
std::vector<GainInterval> met_stretches(const DesignTask& task, const Gains& others) {
  return derivative_gains(task.model, task.trials.loop, task.trials.step, task.trials.specification, others,
                          task.search.kd.least, task.search.kd.most);
}

std::size_t tried(const Design& design) {
  std::size_t sum = 0;
  for (const GainMap& map : design.maps) sum += map.tried();
  return sum;
}

}  // namespace

void print_json(const DesignTask& task, const Design& d, const RuleComparison& comparison) {
  const auto& spec = task.trials.specification;
  ordered_json out = {{"found", d.found}, {"law", task.integral ? "pid" : "pd"}};
  out["gains"] = d.found ? gains_json(task, d.gains) : ordered_json(nullptr);
  out["nearest_gains"] = d.found ? ordered_json(nullptr) : gains_json(task, d.gains);
  out["specification"] = {{"settling_band", spec.settling_band}};
  out["prediction"] = ordered_json::object();
  for (const QuantityInfo& q : quantities()) {
    if (spec[q.id]) out["specification"][std::string(q.name)] = *spec[q.id];
    out["prediction"][std::string(q.name)] =
        estimate_json(d.prediction.quantities[static_cast<std::size_t>(q.id)]);
  }
  out["prediction"]["final_error"] = estimate_json(d.prediction.final_error);
  out["slack"] = {{"model", number_json(d.nominal.slack)}, {"worst", number_json(d.worst.slack)}};
  out["binding"] = d.worst.binding ? ordered_json(info(*d.worst.binding).name) : ordered_json(nullptr);
  out["margin_kept"] = d.found && d.has_margin;
  out["gain_change_borne"] = d.found && d.may_change;
  out["at_edge_of_search"] = d.at_edge;
  out["model_alone_meets_it"] = d.found || d.model_alone;
  out["achievable"] = ordered_json::array();
  for (const Achievable& one : d.achievable) {
    out["achievable"].push_back(
        {{"quantity", info(one.quantity).name}, {"asked", one.asked}, {"best", number_json(one.best)}});
  }
  out["gains_tried"] = tried(d);
  out["carts_tried"] = task.trials.scenarios.size();
  out["kp_searched_V_per_m"] = {task.search.kp.least, task.search.kp.most};
  out["kd_searched_V_s_per_m"] = {task.search.kd.least, task.search.kd.most};
  if (task.search.kp.fixed() && !task.search.kd.fixed()) {
    out["kd_that_meet_it_V_s_per_m"] = ordered_json::array();
    for (const GainInterval& one : met_stretches(task, d.gains)) {
      out["kd_that_meet_it_V_s_per_m"].push_back({one.low, one.high});
    }
  }
  out["tuning_rules"] = ordered_json::array();
  for (const TuningRule& rule : comparison.rules) {
    ordered_json entry = {{"rule", rule.name}, {"from", rule.from}, {"gains", gains_json(task, rule.gains)}};
    for (const QuantityInfo& q : quantities()) {
      if (q.id != Quantity::bandwidth) entry[std::string(q.name)] = number_json(rule.metrics.*q.of);
    }
    entry["met_by_the_model"] = rule.meets;
    entry["met_by_every_cart"] = rule.holds;
    out["tuning_rules"].push_back(std::move(entry));
  }
  out["remarks"] = comparison.remarks;
  fmt::print("{}\n", out.dump(2));
}

void print_table(const DesignTask& task, const Design& d, const RuleComparison& comparison) {
  const auto& spec = task.trials.specification;
  fmt::print("{} gain sets tried, on {} cart{}\n", tried(d), task.trials.scenarios.size(),
             task.trials.scenarios.size() == 1 ? ": the model gives no intervals"
                                               : "s within the model's intervals");
  if (d.found) {
    fmt::print("proposed: {}\n", gains_text(task, d.gains));
  } else if (d.model_alone) {
    fmt::print(
        "no gains meet the specification on every cart; the model itself is met, nearest to all of them is "
        "{}\n",
        gains_text(task, d.gains));
  } else {
    fmt::print("no gains meet the specification; nearest is {}\n", gains_text(task, d.gains));
  }
  fmt::print("\n{:<18} {:>10} {:>24} {:>12}\n", "", "predicted", "least ... greatest", "asked");
  for (const QuantityInfo& q : quantities()) {
    const Estimate& e = d.prediction.quantities[static_cast<std::size_t>(q.id)];
    const auto& limit = spec[q.id];
    const bool broken = limit && d.worst.binding == q.id && !d.worst.met();
    fmt::print("{:<18} {:>10} {:>24} {:>12}{}\n", fmt::format("{} [{}]", q.words, q.unit), shown(e.value, q),
               fmt::format("{} ... {}", shown(e.low, q), shown(e.high, q)), limit ? asked(q, *limit) : "",
               broken ? "   <- binds" : "");
  }
  fmt::print("\n");
  if (d.found) {
    fmt::print("{:.0f} % of the tightest limit ({}) is left in the worst case{}\n", 100 * d.worst.slack,
               info(*d.worst.binding).words,
               d.has_margin ? "" : fmt::format(", less than the {:.0f} % wanted", 100 * task.search.margin));
    fmt::print("{} with both gains {:.0f} % off\n", d.may_change ? "it holds" : "it does NOT always hold",
               100 * task.search.gain_change);
    if (d.at_edge)
      fmt::print("the proposal lies at the edge of the range searched: widen it with --kp, --kd\n");
  }
  for (const Achievable& one : d.achievable) {
    const QuantityInfo& q = info(one.quantity);
    fmt::print("with the other limits kept, {} comes to {} {} (asked {})\n", q.words, shown(one.best, q),
               q.unit, asked(q, one.asked));
  }
  if (!d.found && !d.model_alone && d.achievable.empty())
    fmt::print("no single limit is to blame: two or more have to give way\n");
  if (task.search.kp.fixed() && !task.search.kd.fixed()) {
    for (const GainInterval& one : met_stretches(task, d.gains)) {
      fmt::print("with Kp = {:.4g} V/m the model meets it for Kd from {:.4g} to {:.4g} V s/m\n",
                 task.search.kp.least, one.low, one.high);
    }
  }
  if (!comparison.rules.empty()) {
    fmt::print(
        "\ntuning rules, tried in the same loop\n{:<20} {:>9} {:>9} {:>9} {:>10} {:>10} {:>9}  {:<18} {}\n",
        "", "Kp", "Kd", task.integral ? "Ki" : "", "settled", "overshoot", "rms", "specification", "from");
  }
  for (const TuningRule& r : comparison.rules) {
    fmt::print("{:<20} {:>9.4g} {:>9.4g} {:>9} {:>8} s {:>8} % {:>7.3g} V  {:<18} {}\n", r.name,
               r.gains.kp_V_per_m, r.gains.kd_V_s_per_m,
               task.integral ? fmt::format("{:.4g}", r.gains.ki_V_per_m_s) : "",
               shown(r.metrics.settling_time_s, info(Quantity::settling_time)),
               shown(r.metrics.overshoot, info(Quantity::overshoot)), r.metrics.rms_voltage_V,
               r.holds ? "met" : (r.meets ? "by the model only" : "not met"), r.from);
  }
  for (const std::string& remark : comparison.remarks) fmt::print("{}\n", remark);
}

}  // namespace cartwright::cli
