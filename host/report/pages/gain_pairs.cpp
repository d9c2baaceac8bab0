#include "host/report/pages/gain_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/evaluate/closed_loop.hpp"

namespace cartwright::report {
namespace {

constexpr double kLong_s = 1.0, kShort_s = 0.5;
constexpr double kBefore_s = 0.05;  ///< shown before the step

/// The row in which the reference first moves away from where it started.
std::size_t first_step(const Recording& recording) {
  const auto moved = std::find_if(recording.r_m.begin(), recording.r_m.end(),
                                  [&](double r) { return r != recording.r_m.front(); });
  return moved == recording.r_m.end() ? 0 : static_cast<std::size_t>(moved - recording.r_m.begin());
}

/// One recording per pair of gains: the first that was made with it.
std::vector<const Recording*> one_per_pair(const Session& session) {
  std::vector<const Recording*> out;
  const auto gains = [](const Recording* recording) {
    const PdGains& pd = std::get<PdGains>(recording->controller);
    return std::pair(pd.kp_V_per_m, pd.kd_V_s_per_m);
  };
  for (const Recording& recording : session.recordings) {
    if (recording.experiment != "step" || !std::holds_alternative<PdGains>(recording.controller)) continue;
    const bool known = std::any_of(out.begin(), out.end(),
                                   [&](const Recording* other) { return gains(other) == gains(&recording); });
    if (!known) out.push_back(&recording);
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](const Recording* a, const Recording* b) { return gains(a) < gains(b); });
  return out;
}

double mean_absolute_m(const std::vector<double>& a, const std::vector<double>& b, std::size_t from,
                       std::size_t to) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(std::max<std::size_t>(1, to - from));
}

std::size_t row_at(const Recording& recording, double time_s) {
  return static_cast<std::size_t>(std::lower_bound(recording.t_s.begin(), recording.t_s.end(), time_s) -
                                  recording.t_s.begin());
}

std::vector<double> excerpt(const std::vector<double>& values, std::size_t from, std::size_t to,
                            double factor, double minus = 0) {
  std::vector<double> out;
  for (std::size_t i = from; i < to; ++i) out.push_back(factor * (values[i] - minus));
  return out;
}

Cell gain(double value) {
  Cell cell{fmt::format("{:.4g}", value)};
  cell.numeric = true;
  return cell;
}

struct Compared {
  GainPairError errors;
  Plot plot;
};

Compared compare(const Session& session, const Recording& recording, const std::vector<NamedModel>& models) {
  const PdGains& pd = std::get<PdGains>(recording.controller);
  Compared out{{recording.file, pd.kp_V_per_m, pd.kd_V_s_per_m, {}, {}}, {}};
  const std::size_t step = first_step(recording);
  const double start_s = recording.t_s[step];
  const std::size_t from = row_at(recording, start_s - kBefore_s);
  const std::size_t half = row_at(recording, start_s + kShort_s), end = row_at(recording, start_s + kLong_s);
  const std::vector<double> time_s = excerpt(recording.t_s, from, end, 1, start_s);
  out.plot.title = fmt::format("Kp {:.4g} V/m, Kd {:.4g} V s/m", pd.kp_V_per_m, pd.kd_V_s_per_m);
  out.plot.x = {"time after the step", "s"};
  out.plot.y = {"position", "mm"};
  out.plot.height_px = 210;
  out.plot.linked = "gain pairs";
  out.plot.add({.name = "reference",
                .x = time_s,
                .y = excerpt(recording.r_m, from, end, 1e3),
                .mark = Mark::step,
                .colour = Colour::reference,
                .dashed = true});
  out.plot.add({.name = "measured",
                .x = time_s,
                .y = excerpt(recording.y_m, from, end, 1e3),
                .colour = Colour::measured});
  for (const NamedModel& one : models) {
    const Recording predicted = simulate(one.model, session.rig, recording);
    out.errors.over_1_s_m.push_back(mean_absolute_m(predicted.y_m, recording.y_m, step, end));
    out.errors.over_half_s_m.push_back(mean_absolute_m(predicted.y_m, recording.y_m, step, half));
    out.plot.add(
        {.name = one.name, .x = time_s, .y = excerpt(predicted.y_m, from, end, 1e3), .colour = one.colour});
  }
  return out;
}

Table error_table(std::string caption, const std::vector<NamedModel>& models,
                  const std::vector<GainPairError>& errors, std::vector<double> GainPairError::*over_m) {
  Table table;
  table.caption = std::move(caption);
  table.columns = {{"Kp", "V/m"}, {"Kd", "V s/m"}};
  for (const NamedModel& one : models) table.columns.push_back({one.name, "mm"});
  std::vector<double> sums_mm(models.size());
  for (const GainPairError& one : errors) {
    std::vector<Cell> cells{gain(one.kp_V_per_m), gain(one.kd_V_s_per_m)};
    for (std::size_t m = 0; m < models.size(); ++m) {
      const double error_mm = 1e3 * (one.*over_m)[m];
      cells.push_back(Cell::number(error_mm, 3));
      sums_mm[m] += error_mm;
    }
    table.row(std::move(cells));
  }
  std::vector<Cell> means{Cell("average").emphasise(), Cell("")};
  for (const double sum_mm : sums_mm)
    means.push_back(Cell::number(sum_mm / static_cast<double>(errors.size()), 3).emphasise());
  table.row(std::move(means));
  return table;
}

}  // namespace

std::vector<GainPairError> gain_pair_errors(const Session& session, const std::vector<NamedModel>& models) {
  std::vector<GainPairError> out;
  for (const Recording* recording : one_per_pair(session))
    out.push_back(compare(session, *recording, models).errors);
  return out;
}

void add_gain_pairs(Report& page, const Session& session, const std::vector<NamedModel>& models) {
  std::vector<Plot> plots;
  std::vector<GainPairError> errors;
  for (const Recording* recording : one_per_pair(session)) {
    Compared one = compare(session, *recording, models);
    plots.push_back(std::move(one.plot));
    errors.push_back(std::move(one.errors));
  }
  if (errors.empty()) return;
  page.section("Prediction of every gain pair");
  page.paragraph(
      "Each model is run with the controller and the reference of the recording; nothing of the recorded "
      "motion goes in but where it starts.");
  page.plots(plots, 3);
  page.table(
      error_table("Mean absolute error over 1 s after the step", models, errors, &GainPairError::over_1_s_m));
  page.table(error_table("Over 0.5 s", models, errors, &GainPairError::over_half_s_m));
}

}  // namespace cartwright::report
