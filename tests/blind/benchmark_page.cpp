#include "tests/blind/benchmark_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/blind/baselines/baselines.hpp"
#include "tests/blind/measures.hpp"

namespace cartwright::blind {
namespace {

using namespace report;

/// Shares lie in one row: only the decimals that an interval of some per cent deserves.
Cell reached(const Estimate& e) {
  Cell cell(e);
  return std::isfinite(e.value) ? cell : Cell("–");
}

void verdict(Report& page, const std::vector<Measure>& list, std::size_t sessions) {
  const auto met = static_cast<std::size_t>(
      std::count_if(list.begin(), list.end(), [](const Measure& m) { return m.met; }));
  page.verdict(met == list.size() ? Tone::good : Tone::attention,
               fmt::format("{} of {} targets are met, on {} sessions.", met, list.size(), sessions),
               "Each session is a cart drawn at random that hides something, simulated by code that shares "
               "nothing with the product's plant: other equations, another integrator, another timing.");
}

void table_of_measures(Report& page, const std::vector<Measure>& list, const Outcomes& outcomes) {
  page.section("Measures");
  const std::vector<std::string> baselines = baselines_asked(outcomes);
  Table table{"What was aimed at, what was reached, and what simpler methods reach on the same sessions",
              {{"measure"}, {"target"}, {"reached, 95 % interval"}, {"unit"}, {"of"}},
              {},
              "Shares: exact binomial intervals (Clopper and Pearson); quantiles: between order statistics. "
              "Baselines have no word for a refusal: naming nothing counts as one."};
  for (const std::string& baseline : baselines) table.columns.push_back({baseline});
  for (const Measure& m : list) {
    std::vector<Cell> row{m.name, m.target, reached(m.reached).mark(m.met ? Tone::good : Tone::attention),
                          m.unit, Cell::integer(m.cases)};
    for (const std::string& baseline : baselines) {
      const auto at = m.baselines.find(baseline);
      row.push_back(at == m.baselines.end() ? Cell("") : Cell::number(at->second.value, 3));
    }
    table.row(std::move(row));
  }
  page.table(table);
  if (baselines.empty()) return;
  page.subsection("The baselines");
  page.list(baseline_descriptions());
}

Plot confidences(const Outcomes& outcomes) {
  Plot plot;
  plot.title = "How sure it says it is";
  plot.x = {.label = "confidence stated"};
  plot.y = {.label = "names"};
  plot.height_px = 300;
  std::vector<double> right, wrong;
  for (const Outcome& o : outcomes) {
    for (const NamedEffect& n : o.named) (n.right ? right : wrong).push_back(n.confidence);
  }
  plot.add(histogram("right", right, 20));
  if (!wrong.empty()) plot.add(histogram("wrong", wrong, 20));
  return plot;
}

void reliability_plot(Report& page, const Outcomes& outcomes) {
  page.section("Is its confidence what it says?");
  const std::vector<ReliabilityBin> bins = reliability(outcomes);
  if (bins.empty()) {
    page.paragraph("Nothing was named.");
    return;
  }
  Plot plot;
  plot.title = "How often a name is right, against how sure the diagnosis says it is";
  plot.caption =
      "Groups of names of about the same confidence, bars: 95 % intervals. Above the line: more "
      "careful than need be; below: too sure.";
  plot.x = {.label = "confidence stated", .least = 0, .greatest = 1.02};
  plot.y = {.label = "share that was right", .least = 0, .greatest = 1.02};
  plot.height_px = 300;
  plot.add(
      {.name = "as often as it says", .x = {0, 1}, .y = {0, 1}, .colour = Colour::muted, .dashed = true});
  Series points{.name = "names", .mark = Mark::points, .colour = Colour::model};
  Table table{"", {{"confidence"}, {"mean stated"}, {"names"}, {"right"}, {"share right, 95 % interval"}}};
  for (const ReliabilityBin& bin : bins) {
    points.x.push_back(bin.stated);
    points.y.push_back(bin.share_right.value);
    points.low.push_back(bin.share_right.low);
    points.high.push_back(bin.share_right.high);
    table.row({fmt::format("{:.2f} to {:.2f}", bin.low, bin.high), Cell::number(bin.stated, 3),
               Cell::integer(static_cast<std::size_t>(bin.names)),
               Cell::integer(static_cast<std::size_t>(bin.right)), bin.share_right});
  }
  plot.add(points);
  page.plots({plot, confidences(outcomes)}, 2);
  page.table(table);
}

/// The diagnosis with its intervals, and the baselines as lines.
void add_series(Plot& plot, const std::vector<Detection>& list, const std::vector<double>& x) {
  Series ours{.name = "diagnosis", .x = x, .mark = Mark::points, .colour = Colour::model};
  std::map<std::string, Series> theirs;
  for (std::size_t i = 0; i < list.size(); ++i) {
    ours.y.push_back(100 * list[i].named_first.value);
    ours.low.push_back(100 * list[i].named_first.low);
    ours.high.push_back(100 * list[i].named_first.high);
    for (const auto& [baseline, share] : list[i].baselines) {
      Series& s = theirs[baseline];
      s.x.push_back(x[i]), s.y.push_back(100 * share.value);
    }
  }
  plot.add(std::move(ours));
  for (auto& [baseline, series] : theirs) {
    series.name = baseline, series.dashed = true;
    plot.add(std::move(series));
  }
}

void detection(Report& page, const Outcomes& outcomes) {
  page.section("What can be detected?");
  const std::vector<Detection> by_size = detection_by_size(outcomes);
  if (by_size.empty()) {
    page.paragraph("No session hides an effect of the vocabulary.");
    return;
  }
  Plot sizes, excess;
  sizes.title = "Named first, against the size of the effect";
  sizes.y = excess.y = {.label = "named first", .unit = "%", .least = 0, .greatest = 102};
  std::vector<double> x;
  for (const Detection& d : by_size) {
    sizes.x.categories.push_back(fmt::format("{} ({})", d.label, d.cases));
    x.push_back(static_cast<double>(x.size()));
  }
  add_series(sizes, by_size, x);
  constexpr std::size_t kGroups = 8;
  const std::vector<Detection> groups = detection_by_excess(outcomes, kGroups);
  excess.title = "Named first, against the window error above the noise floor";
  excess.caption =
      "Groups of equally many sessions. Excess: root of the refitted nominal model's squared 0.5 s "
      "window error less the floor's, in units of the floor.";
  excess.x = {.label = "excess window error over noise floor", .logarithmic = true};
  x.clear();
  for (const Detection& d : groups) x.push_back(d.excess_over_floor);
  add_series(excess, groups, x);
  page.plots({sizes, excess}, 2);

  std::vector<std::string> missed;
  for (const Outcome& o : outcomes) {
    if (o.expected.size() != 1 || o.asked.effects.size() != 1 || o.first_right()) continue;
    missed.push_back(fmt::format("{}, {}, draw {}: {}{}; excess {:.2g} floors", o.asked.effects.front(),
                                 blind::name(o.asked.size), o.asked.seed, cartwright::name(o.verdict),
                                 o.named.empty() ? "" : ", " + o.named.front().name, o.excess_over_floor()));
  }
  if (missed.empty()) return;
  page.details(fmt::format("Not named first: {} sessions", missed.size()),
               [&](Report& inside) { inside.list(missed); });
}

std::string right_of(const EffectRow& row, int size) {
  const auto at = row.right_of.find(size);
  return at == row.right_of.end() ? "" : fmt::format("{} of {}", at->second.first, at->second.second);
}

void effects(Report& page, const Outcomes& outcomes) {
  page.section("Effect by effect");
  Table table{
      "Right answers by size, and how far its parameters are off",
      {{"effect"},
       {"third of small"},
       {"small"},
       {"medium"},
       {"large"},
       {"median error", "%"},
       {"90th percentile", "%"},
       {"truth in interval"}},
      {},
      "Effects outside the vocabulary begin with x_; the right answer is to refuse. What has no "
      "counterpart in the vocabulary's law (the phase of a period, shares of two masses) is not compared."};
  for (const EffectRow& row : by_effect(outcomes)) {
    const bool compared = row.parameters > 0;
    table.row({row.effect, right_of(row, 0), right_of(row, 1), right_of(row, 2), right_of(row, 3),
               compared ? Cell::number(100 * row.median_error.value, 2) : Cell(""),
               compared ? Cell::number(100 * row.worst_tenth_error.value, 2) : Cell(""),
               compared ? Cell(fmt::format("{} of {}", row.covered, row.parameters)) : Cell("")});
  }
  page.table(table);
}

void time(Report& page, const Outcomes& outcomes) {
  page.section("Time");
  std::vector<double> diagnosis_s, baselines_s;
  for (const Outcome& o : outcomes) {
    diagnosis_s.push_back(o.time_s);
    if (!o.baselines.empty()) baselines_s.push_back(o.baselines_time_s);
  }
  Plot plot;
  plot.title = "Processor time for a session of 68 s, one thread";
  plot.x = {"time", "s"};
  plot.y = {"sessions", ""};
  plot.add(histogram("diagnosis", diagnosis_s, 30));
  page.plot(plot);
  if (!baselines_s.empty())
    page.note(fmt::format("All baselines together: median {:.1f} s.", quantile(baselines_s, 0.5).value));
}

}  // namespace

Report benchmark_page(const Outcomes& outcomes) {
  const std::vector<Measure> list = measures(outcomes);
  Report page("Benchmark of the diagnosis",
              fmt::format("{} sessions of ten recordings each, 68 s at 1 kHz; Cartwright {}", outcomes.size(),
                          CARTWRIGHT_VERSION));
  verdict(page, list, outcomes.size());
  table_of_measures(page, list, outcomes);
  reliability_plot(page, outcomes);
  detection(page, outcomes);
  effects(page, outcomes);
  time(page, outcomes);
  return page;
}

}  // namespace cartwright::blind
