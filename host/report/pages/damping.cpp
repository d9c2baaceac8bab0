#include "host/report/pages/damping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/model/plant_terms.hpp"
#include "host/report/number.hpp"

namespace cartwright::report {
namespace {

/// Intervals as a line with two points each, so that a value is held over its interval.
Series held(std::string name, const std::vector<DampingInterval>& intervals, Colour colour) {
  Series out{.name = std::move(name), .colour = colour};
  for (const DampingInterval& one : intervals) {
    out.x.insert(out.x.end(), {one.start_s, one.end_s});
    out.y.insert(out.y.end(), 2, one.damping_per_s.value);
  }
  return out;
}

Series held_band(std::string name, const std::vector<DampingInterval>& intervals, Colour colour) {
  Series out{.name = std::move(name), .mark = Mark::band, .colour = colour};
  for (const DampingInterval& one : intervals) {
    out.x.insert(out.x.end(), {one.start_s, one.end_s});
    out.low.insert(out.low.end(), 2, one.damping_per_s.low);
    out.high.insert(out.high.end(), 2, one.damping_per_s.high);
  }
  return out;
}

/// Damping force per speed of a model.
Series law(std::string name, const Model& model, double greatest_speed_m_per_s, Colour colour) {
  constexpr int kPoints = 200;
  const PlantTerms terms(model, false);
  Series out{.name = std::move(name), .colour = colour};
  for (int i = 1; i <= kPoints; ++i) {
    const double speed = greatest_speed_m_per_s * i / kPoints;
    out.x.push_back(speed);
    out.y.push_back((terms.damping(speed) + terms.level(0, speed)) / speed);
  }
  return out;
}

/// "1.913 [1.908, 1.918]"
std::string in_words(const Estimate& estimate) {
  const FormattedEstimate text = format_estimate(estimate);
  return text.interval.empty() ? text.value : text.value + " " + text.interval;
}

Plot over_time(const StepDamping& step) {
  Plot plot;
  plot.title = "Over time";
  plot.x = {"time", "s"};
  plot.y = {"damping", "1/s"};
  plot.height_px = 280;
  plot.y.least = 0;
  plot.add(held_band("95 % interval", step.piecewise.damping, Colour::model));
  plot.add(held("piecewise", step.piecewise.damping, Colour::model));
  plot.add(held("constant", step.constant.damping, Colour::muted));
  return plot;
}

Plot against_speed(const StepDamping& step, const std::optional<Model>& truth) {
  Plot plot;
  plot.title = "Against speed";
  plot.x = {"mean speed", "m/s"};
  plot.y = {"damping", "1/s"};
  plot.height_px = 280;
  Series points{.name = "intervals", .mark = Mark::points, .colour = Colour::measured};
  double top = 0, greatest = 0;
  for (const DampingInterval& one : step.piecewise.damping) {
    points.x.push_back(one.speed_m_per_s);
    points.y.push_back(one.damping_per_s.value);
    points.low.push_back(one.damping_per_s.low);
    points.high.push_back(one.damping_per_s.high);
    top = std::max(top, one.speed_m_per_s);
    greatest = std::max(greatest, one.damping_per_s.value);
  }
  plot.x.least = 0;
  plot.y.least = 0;
  plot.y.greatest = 1.4 * greatest;
  plot.add(std::move(points));
  plot.add(law("exponential law", step.piecewise.model, 1.15 * top, Colour::model));
  if (truth) plot.add(law("true", *truth, 1.15 * top, Colour::truth));
  return plot;
}

Table intervals_table(const StepIdentification& piecewise) {
  Table table;
  table.columns = {{"From", "s"}, {"To", "s"}, {"Mean speed", "m/s"}, {"Damping", "1/s"}};
  for (const DampingInterval& one : piecewise.damping) {
    table.row({Cell::number(one.start_s, 4), Cell::number(one.end_s, 4), Cell::number(one.speed_m_per_s, 3),
               one.damping_per_s});
  }
  table.note = fmt::format(
      "The fit misses the response by {} mm rms. Greatest residual of the optimum's conditions (KKT): {}.",
      format_number(1e3 * piecewise.residual_m, 2), format_number(piecewise.kkt.greatest(), 2));
  return table;
}

}  // namespace

Result<StepDamping> step_damping(const Session& session) {
  StepOptions options;
  auto step = find_step(session, options);
  if (!step) {
    options.input = StepInput::voltage;
    step = find_step(session, options);
  }
  if (!step) return tl::unexpected(step.error());
  auto constant = identify_step(*step, options);
  if (!constant) return tl::unexpected(constant.error());
  options.intervals = 6;
  auto piecewise = identify_step(*step, options);
  if (!piecewise) return tl::unexpected(piecewise.error());
  return StepDamping{std::move(*constant), std::move(*piecewise), options.input == StepInput::voltage};
}

void add_damping(Report& page, const StepDamping& step, const std::optional<Model>& truth) {
  const Model& law = step.piecewise.model;
  page.section("Damping of one step response");
  page.paragraph(fmt::format(
      "The integral method on {}, from {}: damping constant over the response, and over each of {} intervals "
      "with position and velocity continuous between them. Constant: gain {} m/s²/V, damping {} 1/s. "
      "Piecewise: gain {} m/s²/V.",
      step.piecewise.file, step.from_voltage ? "the recorded voltage" : "the control error",
      step.piecewise.damping.size(), in_words(step.constant.estimates.front().estimate),
      in_words(step.constant.damping.front().damping_per_s),
      in_words(step.piecewise.estimates.front().estimate)));
  page.plots({over_time(step), against_speed(step, truth)}, 2);
  page.note(fmt::format("Law: C(v) = {} exp(−{} |v|) + {} 1/s, v in m/s, fitted to the six points.",
                        format_number(law[Parameter::exponential_alpha1]),
                        format_number(law[Parameter::exponential_alpha2]),
                        format_number(law[Parameter::exponential_gamma])));
  page.details("Values of every interval",
               [&](Report& inside) { inside.table(intervals_table(step.piecewise)); });
}

}  // namespace cartwright::report
