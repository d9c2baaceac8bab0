#include "host/diagnose/show/diagnosis_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/diagnose/judge/name_from_drive.hpp"
#include "host/diagnose/judge/statement.hpp"
#include "host/diagnose/show/drive_page.hpp"
#include "host/diagnose/show/location_page.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/replay.hpp"
#include "host/report/unit.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using namespace report;

constexpr std::size_t kRunnersUpShown = 8;  // all are in diagnosis.json

Cell micrometres(double value_m) {
  return Cell::number(1e6 * value_m, 3);
}

/// A statement's plain characters as a page can show them.
std::string typeset(std::string text) {
  for (const auto& [plain, shown] :
       {std::pair<std::string_view, std::string_view>{"+-", "±"}, {"/s^2", "/s²"}, {" um", " µm"}}) {
    for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain, at + shown.size()))
      text.replace(at, plain.size(), shown);
  }
  return text;
}

void verdict(Report& page, const Diagnosis& d) {
  const std::string detail = typeset(d.drive ? statement_of_lines(*d.drive) : statement_of_windows(d));
  switch (d.verdict) {
    case Verdict::no_mismatch:
      page.verdict(Tone::good, "The model fits: nothing beyond noise.", detail);
      return;
    case Verdict::parameters_only:
      page.verdict(Tone::attention, "The physics is right, its numbers are not.", detail);
      return;
    case Verdict::missing_physics: {
      std::string sentence;
      for (const Effect& effect : d.effects)
        sentence += (sentence.empty() ? "" : " ") + typeset(effect.statement);
      page.verdict(Tone::attention, sentence, detail);
      return;
    }
    case Verdict::unexplained:
      page.verdict(Tone::bad, "Something is missing that no term of the vocabulary explains.",
                   typeset(d.unexplained->why_refused) + ". " + detail);
      return;
  }
}

/// What each recording says for each effect, and what each effect is worth.
void add_support(Report& page, const Diagnosis& d) {
  std::vector<const Effect*> asked;
  for (const Effect& effect : d.effects) {
    if (!effect.support.recordings.empty()) asked.push_back(&effect);
  }
  if (asked.empty()) return;
  Table says{
      "Does every recording say so? How much likelier its readings are with the effect than without "
      "it, everything else refitted, and 95 % interval",
      {{"recording"}}};
  for (const Effect* effect : asked) says.columns.push_back({std::string(info(effect->term).name), "nats"});
  for (std::size_t r = 0; r < asked.front()->support.recordings.size(); ++r) {
    std::vector<Cell> row{asked.front()->support.recordings[r].file};
    for (const Effect* effect : asked) {
      const RecordingSays& one = effect->support.recordings[r];
      row.emplace_back(Estimate::within(one.nats, normal(0.95) * one.standard_error));
    }
    says.row(std::move(row));
  }
  page.table(says);
  std::vector<std::string> worth;
  for (const Effect* effect : asked)
    worth.push_back(fmt::format("{}: {}", info(effect->term).name,
                                typeset(statement_of_support(effect->support, d.noise_floor_m))));
  page.list(worth);
}

void what(Report& page, const Diagnosis& d) {
  page.section("What was left out?");
  if (d.effects.empty()) {
    page.paragraph(d.verdict == Verdict::unexplained ? "No named effect is adequate."
                                                     : "Nothing that stands above noise.");
  }
  Table effects{
      "Effects, strongest first",
      {{"effect"}, {"parameter"}, {"value and 95 % interval"}, {"unit"}, {"confidence"}, {"also possible"}}};
  for (const Effect& effect : d.effects) {
    const std::string also = names_of(effect.equivalent);
    bool first = true;
    for (const auto& [id, e] : effect.parameters) {
      const bool bound =
          std::find(effect.at_bound.begin(), effect.at_bound.end(), id) != effect.at_bound.end();
      effects.row({first ? std::string(info(effect.term).name) : std::string(),
                   std::string(info(id).key) + (bound ? " (at its bound)" : ""), e, unit_of(info(id).key),
                   first ? Cell::number(effect.confidence, 2) : Cell(), first ? also : std::string()});
      first = false;
    }
  }
  if (!effects.rows.empty()) page.table(effects);
  add_support(page, d);
  Table places{
      "Where they act: the stretch, of two ends the stronger, on which an effect's push has twice its mean "
      "power and more (of frequencies the middle 80 %); along other axes it acts everywhere",
      {{"effect"}, {"axis"}, {"from"}, {"to"}, {"unit"}}};
  for (const Effect& effect : d.effects) {
    for (const auto& [axis, stretch] : effect.where) {
      if (!stretch.empty())
        places.row({std::string(info(effect.term).name), axis, Cell::number(stretch.front(), 3),
                    Cell::number(stretch.back(), 3), unit_of(axis)});
    }
  }
  if (!places.rows.empty()) page.table(places);
  Table numbers{"Numbers of the nominal terms",
                {{"parameter"}, {"nominal"}, {"refitted alone"}, {"found, 95 % interval"}, {"unit"}}};
  for (const NominalParameter& p : d.parameters) {
    numbers.row(
        {dotted_name(p.id), p.nominal, p.with_nominal_terms_only, p.refitted, unit_of(info(p.id).key)});
  }
  page.table(numbers);
  if (d.unexplained) {
    page.subsection("Unexplained");
    page.paragraph(statement_of_left_over(*d.unexplained) + " The push itself, usable as a table:");
    page.plot(map_plot(d.unexplained->curve, {}));
    const std::string periods = statement_of_periods(d.unexplained->periods_m);
    if (!periods.empty()) page.paragraph(periods);
  }
}

/// Measured and predicted, and below it the errors.
void overlay(Report& page, const Recording& r, const std::string& how, const std::vector<double>& nominal_m,
             const std::vector<double>& found_m) {
  Plot plot, error;
  plot.title = r.file + ": " + how;
  plot.linked = error.linked = r.file;
  plot.x = error.x = {"t_s", "s"};
  plot.y = {"position", "mm"};
  error.title = "error";
  error.y = {"measured less predicted", "µm"};
  error.height_px = 170;
  Series measured{"measured"}, nominal{"nominal"}, found{"found"}, nominal_error{"nominal"},
      found_error{"found"};
  measured.colour = Colour::measured;
  nominal.colour = nominal_error.colour = Colour::other_model;
  found.colour = found_error.colour = Colour::model;
  for (std::size_t k = 0; k < r.size(); ++k) {
    measured.y.push_back(1e3 * r.y_m[k]);
    nominal.y.push_back(1e3 * nominal_m[k]);
    found.y.push_back(1e3 * found_m[k]);
    nominal_error.y.push_back(1e6 * (r.y_m[k] - nominal_m[k]));
    found_error.y.push_back(1e6 * (r.y_m[k] - found_m[k]));
  }
  for (Series* s : {&measured, &nominal, &found, &nominal_error, &found_error}) s->x = r.t_s;
  plot.series = {measured, nominal, found};
  error.series = {nominal_error, found_error};
  page.plot(plot);
  page.plot(error);
}

void better(Report& page, const Diagnosis& d, const Session& session, const Model& nominal) {
  page.section("How much better is the model now?");
  Table table{
      "Root-mean-square errors: 0.5 s windows replayed from the recorded voltage, start state of each "
      "fitted; and "
      "the recorded controller run on the model from its reference",
      {{"recordings"},
       {"predicted"},
       {"nominal", "µm"},
       {"refitted", "µm"},
       {"with effects", "µm"},
       {"noise floor", "µm"}}};
  const auto row = [&](const std::string& which, const char* how, const Errors& e, const Cell& floor) {
    if (!std::isfinite(e.nominal)) return;
    table.row({which, how, micrometres(e.nominal), micrometres(e.refitted),
               micrometres(e.with_effects).emphasise(), floor});
  };
  row("used", "windows", d.used, micrometres(d.noise_floor_m));
  row("used", "closed loop", d.used_closed_loop, Cell(""));
  std::string held;
  for (const std::string& file : d.held_out_recordings) held += (held.empty() ? "" : ", ") + file;
  if (!held.empty()) {
    row("held out of everything: " + held, "windows", d.held_out, Cell(""));
    row("held out of everything: " + held, "closed loop", d.held_out_closed_loop, Cell(""));
  }
  page.table(table);
  if (d.drive) add_drive(page, *d.drive, session);
  const auto shown = std::find_if(
      session.recordings.begin(), session.recordings.end(),
      [&](const Recording& r) { return held.empty() || r.file == d.held_out_recordings.front(); });
  overlay(page, *shown, "0.5 s windows replayed from the recorded voltage", replay_windows(nominal, *shown),
          replay_windows(d.model, *shown));
  if (shown->has_controller()) {
    overlay(page, *shown, "the controller run on the model from its reference",
            simulate(nominal, session.rig, *shown).y_m, simulate(d.model, session.rig, *shown).y_m);
  }
}

void what_else(Report& page, const Diagnosis& d) {
  page.section("What else could it be?");
  if (!d.runner_up.empty()) {
    Table others{
        "Others, each fitted in the place of an effect and everything else refitted alongside",
        {{"effect"}, {"instead of"}, {"log-likelihood behind", "nats"}, {"confidence"}},
        {},
        "Ten nats and more is beyond doubt where the noise is as fitted and nothing stays unexplained; "
        "below zero it scored higher, with more numbers."};
    for (const RunnerUp& other : d.runner_up) {
      if (others.rows.size() == kRunnersUpShown) break;
      others.row({std::string(info(other.term).name), std::string(info(other.instead_of).name),
                  Cell::number(other.score_behind, 3), Cell::number(other.confidence, 2)});
    }
    page.table(others);
  } else if (d.drive) {
    page.paragraph(fmt::format(
        "The best line of the drive over time, in the place of the best over the way, is {:.3g} nats behind. "
        "Other effects are not compared: they show in accelerations, and a servo that holds the speed leaves "
        "none.",
        d.drive->time_behind));
  } else {
    page.paragraph("No other effect was promising enough to be fitted.");
  }
  Plot plot;
  plot.title = "What each start of each term promised before fitting (refitted nominal model, linear)";
  plot.x = {"log-likelihood gain", "nats"};
  Series bars{"promise"};
  bars.mark = Mark::bars;
  std::vector<Term> seen;
  for (const Promise& promise : d.search.promises) {
    if (std::find(seen.begin(), seen.end(), promise.term) != seen.end()) continue;
    seen.push_back(promise.term);
    plot.y.categories.emplace_back(info(promise.term).name);
    bars.y.push_back(static_cast<double>(bars.y.size()));
    bars.x.push_back(std::max(0.0, promise.log_likelihood_gain));
    if (seen.size() >= 10) break;
  }
  plot.add(bars);
  if (!seen.empty()) page.plot(plot);
}

void next(Report& page, const Diagnosis& d) {
  page.section("What should I measure next?");
  if (d.next_experiment) {
    page.paragraph(d.next_experiment->experiment + " " +
                   statement_of_next(*d.next_experiment, d.unexplained.has_value()));
    page.code("cartwright device run " + d.next_experiment->experiment);
  } else if (std::any_of(d.effects.begin(), d.effects.end(),
                         [](const Effect& effect) { return !effect.equivalent.empty(); })) {
    page.paragraph("No experiment on the menu is likely to tell those from one another.");
  } else if (d.unexplained) {
    page.paragraph("What has no name cannot be simulated, so no experiment can be chosen for it.");
  } else {
    page.paragraph("Nothing: this data leaves no two candidates that it cannot tell apart.");
  }
  if (!d.remarks.empty()) page.list(d.remarks);
}

}  // namespace

report::Report diagnosis_page(const Diagnosis& diagnosis, const Session& session, const Model& nominal) {
  double seconds = 0;
  for (const Recording& r : session.recordings) seconds += r.t_s.back() - r.t_s.front();
  Report page("Diagnosis of " + session.rig.name,
              fmt::format("{} recordings, {:.0f} s, at {:g} Hz; Cartwright {}", session.recordings.size(),
                          seconds, session.rig.sample_rate_hz, CARTWRIGHT_VERSION));
  verdict(page, diagnosis);
  add_location(page, diagnosis);
  what(page, diagnosis);
  better(page, diagnosis, session, nominal);
  what_else(page, diagnosis);
  next(page, diagnosis);
  return page;
}

}  // namespace cartwright
