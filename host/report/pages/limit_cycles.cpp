#include "host/report/pages/limit_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cartwright::report {
namespace {

constexpr std::size_t kCyclesShown = 3;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const Recording* find(const Session& session, const std::string& file) {
  const auto found = std::find_if(session.recordings.begin(), session.recordings.end(),
                                  [&](const Recording& recording) { return recording.file == file; });
  return found == session.recordings.end() ? nullptr : &*found;
}

std::vector<double> millimetres(const std::vector<double>& values, std::size_t from, std::size_t to) {
  std::vector<double> out;
  for (std::size_t i = from; i < to; ++i) out.push_back(1e3 * values[i]);
  return out;
}

Plot cycle_plot(const Recording& recording, const RelayReport::Entry& entry) {
  const std::vector<Cycle>& cycles = entry.cycle->cycles;
  const std::size_t from = cycles[cycles.size() - std::min(kCyclesShown, cycles.size())].first;
  const std::size_t to = std::min(cycles.back().last, recording.size());
  const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(to);
  const std::vector<double> time_s(recording.t_s.begin() + begin, recording.t_s.begin() + end);
  Plot plot;
  plot.title = fmt::format("{}: h1 {:.3g} V, h2 {:.3g} V", entry.file, entry.gains.h1_V, entry.gains.h2_V);
  plot.x = {"time", "s"};
  plot.y = {"position", "mm"};
  plot.add({.name = "measured",
            .x = time_s,
            .y = millimetres(recording.y_m, from, to),
            .colour = Colour::measured});
  std::vector<double> sine_mm;
  for (const double t : time_s) sine_mm.push_back(1e3 * entry.cycle->sine.at(t));
  plot.add({.name = "fitted sine", .x = time_s, .y = std::move(sine_mm), .colour = Colour::other_model});
  if (entry.predicted_m.size() == recording.size()) {
    plot.add({.name = "match in time",
              .x = time_s,
              .y = millimetres(entry.predicted_m, from, to),
              .colour = Colour::model});
  }
  return plot;
}

Estimate scaled(const Estimate& estimate, double factor) {
  return {factor * estimate.value, factor * estimate.low, factor * estimate.high};
}

Table features_table(const RelayReport& relay) {
  Table table;
  table.caption = "Limit cycles";
  table.columns = {{"Recording"},          {"h1", "V"},         {"h2", "V"},         {"Cycles"},
                   {"Settled after", "s"}, {"Amplitude", "mm"}, {"Frequency", "Hz"}, {"Offset", "mm"},
                   {"Match, rms", "mm"}};
  for (const RelayReport::Entry& entry : relay.recordings) {
    if (!entry.cycle) continue;
    const LimitCycle& cycle = *entry.cycle;
    table.row({entry.file, Cell::number(entry.gains.h1_V, 3), Cell::number(entry.gains.h2_V, 3),
               Cell::integer(cycle.cycles.size()), Cell::number(cycle.settled_s, 3),
               scaled(cycle.sine.amplitude, 1e3), cycle.sine.frequency_hz, scaled(cycle.sine.offset, 1e3),
               Cell::number(1e3 * entry.rms_m, 3)});
  }
  return table;
}

/// Tp/Kp of a model; f1 and 1/Kp + f2 as well where it holds nothing but viscous and Coulomb friction, else
/// NaN.
RelayCombinations of_model(const Model& model) {
  const double beta = model[Parameter::voltage_gain];
  const auto value = [&](Term term, Parameter parameter) { return model.has(term) ? model[parameter] : 0.0; };
  for (const TermInfo& term : terms()) {
    const bool plain = term.id == Term::viscous_friction || term.id == Term::coulomb_friction ||
                       term.id == Term::constant_force;
    if (model.has(term.id) && !plain) return {1 / beta, kNaN, kNaN};
  }
  return {1 / beta, value(Term::coulomb_friction, Parameter::coulomb_level) / beta,
          value(Term::viscous_friction, Parameter::viscous_coefficient) / beta};
}

Table cart_table(const RelayReport& relay, const std::optional<Model>& truth) {
  Table table;
  table.caption = "What the relay tests say of the cart";
  table.columns = {{"Quantity"},      {"Unit"}, {"Equations as printed"}, {"Describing function, corrected"},
                   {"Match in time"}, {"True"}};
  std::optional<RelayCombinations> printed, exact;
  if (relay.published) {
    const RelayFourParameters& four = *relay.published;
    printed = RelayCombinations{four.tp_s / four.kp, four.f1_V, 1 / four.kp + four.f2};
  }
  if (truth) exact = of_model(*truth);
  struct Row {
    const char *name, *meaning, *unit;
    double RelayCombinations::*member;
  };
  constexpr Row rows[] = {{"Tp/Kp", "", "V s²/m", &RelayCombinations::tp_over_kp},
                          {"f1", ", Coulomb level", "V", &RelayCombinations::f1_V},
                          {"1/Kp+f2", ", viscous", "V s/m", &RelayCombinations::inverse_kp_plus_f2}};
  const auto matched = [&](const std::string& name) {
    const auto found = std::find_if(relay.combinations.begin(), relay.combinations.end(),
                                    [&](const RelayReport::Value& value) { return value.name == name; });
    return found == relay.combinations.end() ? Cell("–") : Cell(found->estimate);
  };
  const auto cell = [](const std::optional<RelayCombinations>& from, const Row& row) {
    return from ? Cell((*from).*row.member) : Cell("–");
  };
  for (const Row& row : rows) {
    table.row({row.name + std::string(row.meaning), row.unit, cell(printed, row), cell(relay.corrected, row),
               matched(row.name), cell(exact, row)});
  }
  table.note =
      "In the words of the relay paper: G(s) = Kp/(s (Tp s + 1)), friction (f1 + f2 |v|) sgn v in volts; f2 "
      "and 1/Kp enter only as their sum.";
  if (exact && std::isnan(exact->f1_V)) {
    table.note +=
        " The true cart has other friction than Coulomb and viscous, so the last two have no true value; "
        "the curves of friction against speed compare it.";
  }
  return table;
}

}  // namespace

void add_limit_cycles(Report& page, const Session& session, const RelayReport& relay,
                      const std::optional<Model>& truth) {
  page.section("Limit cycles");
  std::vector<Plot> plots;
  std::vector<std::string> refused;
  for (const RelayReport::Entry& entry : relay.recordings) {
    const Recording* recording = find(session, entry.file);
    if (!entry.cycle) {
      refused.push_back(entry.file + ": " + entry.refused);
    } else if (recording && !entry.cycle->cycles.empty()) {
      plots.push_back(cycle_plot(*recording, entry));
    }
  }
  page.plots(plots, 2);
  page.table(features_table(relay));
  if (!refused.empty()) {
    page.paragraph("Refused:");
    page.list(refused);
  }
  page.table(cart_table(relay, truth));
  for (const Combination& one : relay.not_separable) page.note(one.expression + ": " + one.why);
}

}  // namespace cartwright::report
