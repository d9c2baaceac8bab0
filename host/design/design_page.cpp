#include "host/design/design_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/unit.hpp"

namespace cartwright::design {
namespace {

using namespace report;

std::string gains_text(const Gains& g, bool integral) {
  std::string text = fmt::format("Kp = {:.4g} V/m, Kd = {:.4g} V s/m", g.kp_V_per_m, g.kd_V_s_per_m);
  if (integral) text += fmt::format(", Ki = {:.4g} V/(m s)", g.ki_V_per_m_s);
  return text;
}

std::string limit_text(const QuantityInfo& q, double limit) {
  return fmt::format("{} {} {:.4g} {}", q.words, q.at_least ? "at least" : "at most", limit * q.shown_per_si,
                     q.unit);
}

std::string specification_text(const Specification& spec) {
  std::string text;
  for (const QuantityInfo& q : quantities()) {
    if (!spec[q.id]) continue;
    text += (text.empty() ? "" : ", ") + limit_text(q, *spec[q.id]);
    if (q.id == Quantity::settling_time) text += fmt::format(" (within {:.3g} %)", 100 * spec.settling_band);
  }
  return text;
}

void verdict(Report& page, const DesignPage& c) {
  const Design& d = c.design;
  if (d.found) {
    page.verdict(
        d.has_margin && d.may_change ? Tone::good : Tone::attention,
        "Proposed: " + gains_text(d.gains, c.integral) + ".",
        fmt::format("Met by all {} carts tried; {:.0f} % of the tightest limit, {}, is left in the worst "
                    "case. With both gains {:.0f} % off it {}. Nothing has been applied.",
                    c.trials.scenarios.size(), 100 * d.worst.slack, info(*d.worst.binding).words,
                    100 * c.search.gain_change, d.may_change ? "still holds" : "does not always hold"));
    return;
  }
  std::string detail = "Nearest: " + gains_text(d.gains, c.integral) + ".";
  for (const Achievable& one : d.achievable) {
    const QuantityInfo& q = info(one.quantity);
    detail += fmt::format(" With the other limits kept, {} comes to {:.4g} {}.", q.words,
                          q.shown_per_si * one.best, q.unit);
  }
  page.verdict(Tone::bad,
               d.model_alone ? "The model meets it, but no gains do so on every cart within its intervals."
                             : "No gains in the range searched meet the specification.",
               detail);
}

void facts(Report& page, const DesignPage& c) {
  const Loop& loop = c.trials.loop;
  const StepTest& step = c.trials.step;
  page.facts(
      {{"Model", c.model_name},
       {"Asked", specification_text(c.trials.specification)},
       {"Law", loop.ideal
                   ? "continuous, Eq. 62: no limit, filter or encoder"
                   : fmt::format("{} at {:g} Hz, limit ±{:g} V, derivative of the {} filtered at {:g} Hz",
                                 c.integral ? "PID" : "PD", 1 / loop.period_s, loop.voltage_limit_V,
                                 loop.derivative_on_measurement ? "measurement" : "error",
                                 loop.derivative_filter_hz)},
       {"Encoder", loop.encoder_resolution_m > 0
                       ? fmt::format("{:.4g} µm per count", 1e6 * loop.encoder_resolution_m)
                       : std::string("does not round")},
       {"Rig", c.rig_name.empty() ? "none given" : c.rig_name},
       {"Step", fmt::format("{:.4g} mm from {:.4g} mm, watched for {:.3g} s", 1e3 * step.step_m,
                            1e3 * step.start_m, step.duration_s)},
       {"Made by", "cartwright " CARTWRIGHT_VERSION}});
}

void map_section(Report& page, const DesignPage& c) {
  page.section("Which gains meet it");
  std::size_t tried = 0;
  std::vector<Plot> plots;
  for (const GainMap& map : c.design.maps) {
    tried += map.tried();
    plots.push_back(map_plot(c, map));
  }
  page.paragraph(fmt::format(
      "{} gain sets were tried: a lattice over the whole range, finer where the answer changes. Blue keeps "
      "every limit, orange breaks one; a response that never settles is the deepest orange.",
      tried));
  plots.size() == 1 ? page.plot(plots.front()) : page.plots(plots, 2);
}

Series band(const std::vector<double>& t, const std::vector<double>& low, const std::vector<double>& high,
            double factor, std::size_t carts) {
  Series series{fmt::format("{} carts", carts), t};
  series.mark = Mark::band;
  series.colour = Colour::muted;
  for (std::size_t k = 0; k < t.size(); ++k) {
    series.low.push_back(factor * low[k]);
    series.high.push_back(factor * high[k]);
  }
  return series;
}

Series line(std::string name, const std::vector<double>& t, const std::vector<double>& values, double factor,
            Colour colour) {
  Series series{std::move(name), t};
  series.colour = colour;
  for (const double value : values) series.y.push_back(factor * value);
  return series;
}

void response_section(Report& page, const DesignPage& c) {
  const Prediction& p = c.design.prediction;
  const StepTest& step = c.trials.step;
  const std::size_t carts = c.trials.scenarios.size();
  page.section(c.design.found ? "What to expect" : "What the nearest gains do");
  Plot position, voltage;
  position.linked = voltage.linked = "response";
  position.x = voltage.x = {"time", "s"};
  position.y = {"position", "mm"};
  voltage.y = {"voltage", "V"};
  voltage.height_px = 180;
  if (carts > 1) position.add(band(p.t_s, p.y_low_m, p.y_high_m, 1e3, carts));
  if (carts > 1) voltage.add(band(p.t_s, p.u_low_V, p.u_high_V, 1, carts));
  position.add(line("model", p.t_s, p.y_m, 1e3, Colour::model));
  voltage.add(line("model", p.t_s, p.u_V, 1, Colour::model)).mark = Mark::step;
  Plot off;
  off.linked = "response";
  off.x = position.x;
  off.y = {"off the reference, part of the step", "%"};
  off.height_px = 200;
  const double shown_percent = std::max(500 * step.settling_band, 2.0);
  off.y.least = -shown_percent;
  off.y.greatest = shown_percent;
  const auto percent = [&](const std::vector<double>& y_m) {
    std::vector<double> out;
    for (const double y : y_m) out.push_back(100 * ((y - step.start_m) / step.step_m - 1));
    return out;
  };
  if (carts > 1) off.add(band(p.t_s, percent(p.y_low_m), percent(p.y_high_m), 1, carts));
  off.add(line("model", p.t_s, percent(p.y_m), 1, Colour::model));
  position.guides = {{Guide::Along::y, 1e3 * (step.start_m + step.step_m), "reference"}};
  if (const auto& settled_s = c.trials.specification[Quantity::settling_time]) {
    const double band_percent = 100 * step.settling_band;
    off.guides = {{Guide::Along::y, band_percent, fmt::format("+{:.3g} %", band_percent)},
                  {Guide::Along::y, -band_percent, fmt::format("−{:.3g} %", band_percent)},
                  {Guide::Along::x, *settled_s, "settled"}};
  }
  page.plot(position);
  page.plot(off);
  page.plot(voltage);
  Table table{"Predicted, with the least and greatest of all carts",
              {{"quantity"}, {"predicted"}, {"unit"}, {"asked"}}};
  for (const QuantityInfo& q : quantities()) {
    Estimate e = p.quantities[static_cast<std::size_t>(q.id)];
    for (double* value : {&e.value, &e.low, &e.high}) *value *= q.shown_per_si;
    const auto& limit = c.trials.specification[q.id];
    Cell asked =
        limit ? Cell(fmt::format("{} {:.4g}", q.at_least ? "≥" : "≤", *limit * q.shown_per_si)) : Cell("");
    if (limit) {
      const bool broken =
          !(q.at_least ? e.low >= *limit * q.shown_per_si : e.high <= *limit * q.shown_per_si);
      asked.mark(broken ? Tone::bad : Tone::good);
    }
    table.row(
        {std::string(q.words), e.low < e.high ? Cell(e) : Cell::number(e.value), std::string(q.unit), asked});
  }
  if (std::isnan(p.quantities[static_cast<std::size_t>(Quantity::bandwidth)].value)) {
    table.note = "No bandwidth: the response is still moving at the end of the test.";
  }
  page.table(table);
}

void rules_section(Report& page, const DesignPage& c) {
  if (c.rules.rules.empty() && c.rules.remarks.empty()) return;
  page.section("Tuning rules beside it");
  page.paragraph("Each rule's gains, run in the same loop as the proposal.");
  Table table{"", {{"rule"}, {"from"}, {"Kp", "V/m"}, {"Kd", "V s/m"}}};
  if (c.integral) table.columns.push_back({"Ki", "V/(m s)"});
  for (const QuantityInfo& q : quantities()) {
    if (q.id != Quantity::bandwidth) table.columns.push_back({std::string(q.words), std::string(q.unit)});
  }
  table.columns.push_back({"specification"});
  const auto row = [&](const std::string& name, const std::string& from, const Gains& g, const StepMetrics& m,
                       Cell answer) {
    std::vector<Cell> cells{name, from, g.kp_V_per_m, g.kd_V_s_per_m};
    if (c.integral) cells.emplace_back(g.ki_V_per_m_s);
    for (const QuantityInfo& q : quantities()) {
      if (q.id != Quantity::bandwidth) cells.push_back(Cell::number(m.*q.of * q.shown_per_si, 3));
    }
    cells.push_back(std::move(answer));
    table.row(std::move(cells));
  };
  const Trials& trials = c.trials;
  row(c.design.found ? "proposed" : "nearest", "search", c.design.gains,
      trials.metrics(trials.scenarios.front(), c.design.gains),
      c.design.found ? Cell("met").mark(Tone::good) : Cell("not met").mark(Tone::bad));
  for (const TuningRule& rule : c.rules.rules) {
    row(rule.name, rule.from, rule.gains, rule.metrics,
        rule.holds   ? Cell("met").mark(Tone::good)
        : rule.meets ? Cell("by the model only").mark(Tone::attention)
                     : Cell("not met").mark(Tone::bad));
  }
  page.table(table);
  if (!c.rules.remarks.empty()) page.list(c.rules.remarks);
}

void carts_section(Report& page, const DesignPage& c) {
  if (c.trials.scenarios.size() < 2) return;
  page.section("The carts it was tried on");
  page.paragraph(fmt::format(
      "{} carts: the model, corners of the box its intervals span, the ends of every interval, and points "
      "within{}. {} of them were tried all over the map.",
      c.trials.scenarios.size(),
      c.trials.scenarios.front().model.has(Term::motor_heating) ? ", cold and warm" : "", c.trials.mapped));
  if (c.intervals.empty()) return;
  Table table{"", {{"parameter"}, {"value and 95 % interval"}, {"unit"}}};
  for (const ParameterInterval& one : c.intervals) {
    const std::string name = dotted_name(one.id);
    table.row({name, Estimate{c.trials.scenarios.front().model[one.id], one.low, one.high}, unit_of(name)});
  }
  page.table(table);
}

}  // namespace

Report design_page(const DesignPage& content) {
  Report page("Gains from a model", specification_text(content.trials.specification));
  verdict(page, content);
  facts(page, content);
  map_section(page, content);
  response_section(page, content);
  rules_section(page, content);
  carts_section(page, content);
  if (!content.gain_file.empty()) {
    page.section("To use it");
    page.paragraph("The gain file. It changes nothing until it is flashed.");
    page.code(content.gain_file + "\ncartwright device gains flash gains.toml");
  }
  return page;
}

}  // namespace cartwright::design
