#include "host/diagnose/show/location_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/unit.hpp"

namespace cartwright {

using namespace report;

Plot map_plot(const AxisMap& before, const AxisMap& after) {
  Plot plot;
  plot.title = before.axis + (before.parity == "odd" ? ", against the motion" : "");
  plot.x = {before.axis, unit_of(before.axis)};
  plot.y = {"missing push", "m/s²"};
  plot.height_px = 190;
  Series estimate{"refitted nominal"}, band{"chance (95 %, all axes)"}, left{"after"};
  band.mark = Mark::band;
  band.colour = Colour::muted;
  estimate.mark = left.mark = Mark::step;
  estimate.colour = Colour::warning;
  left.colour = Colour::model;
  const auto bin = [](Series& s, double low, double high, double value) {
    s.x.insert(s.x.end(), {low, high});
    s.y.insert(s.y.end(), {value, value});
  };
  for (std::size_t i = 0; i < before.low.size(); ++i) {
    bin(band, before.low[i], before.high[i], 0);
    band.low.insert(band.low.end(), {-before.band_m_per_s2[i], -before.band_m_per_s2[i]});
    band.high.insert(band.high.end(), {before.band_m_per_s2[i], before.band_m_per_s2[i]});
    bin(estimate, before.low[i], before.high[i], before.push_m_per_s2[i]);
  }
  for (std::size_t i = 0; i < after.low.size(); ++i)
    bin(left, after.low[i], after.high[i], after.push_m_per_s2[i]);
  plot.add(band);
  plot.add(estimate);
  plot.add(left);
  return plot;
}

namespace {

Plot profile_plot(const Profile& before, const Profile& after) {
  Plot plot;
  plot.title = before.axis;
  plot.x = {before.axis, unit_of(before.axis)};
  const bool signed_values = before.axis == "input_lag_s";
  plot.y = signed_values ? Axis{"correlation", ""} : Axis{"log-likelihood gain", "nats"};
  plot.height_px = 190;
  Series estimate{"refitted nominal"}, band{"chance (95 %)"}, left{"after"};
  estimate.colour = Colour::warning;
  left.colour = Colour::model;
  band.mark = Mark::band;
  band.colour = Colour::muted;
  estimate.x = before.at, estimate.y = before.value;
  left.x = after.at, left.y = after.value;
  band.x = {before.at.front(), before.at.back()};
  band.y = {0, 0};
  band.low.assign(2, signed_values ? -before.band : 0);
  band.high.assign(2, before.band);
  plot.series = {band, estimate, left};
  return plot;
}

}  // namespace

void add_location(Report& page, const Diagnosis& d) {
  page.section("Where does the model fail?");
  page.paragraph(
      "The push that the refitted nominal model would need, estimated along one axis at a time without "
      "naming any "
      "physics. Grey is what chance alone reaches anywhere on any axis in one session of twenty.");
  std::vector<Plot> plots;
  std::string flat;
  for (std::size_t i = 0; i < d.before.axes.size(); ++i) {
    const AxisMap& map = d.before.axes[i];
    if (map.flat()) {
      flat += fmt::format("{}{}{}", flat.empty() ? "" : ", ", map.axis,
                          map.parity == "odd" ? " (against the motion)" : "");
      continue;
    }
    plots.push_back(map_plot(map, d.after.axes[i]));
  }
  const auto before = d.before.profiles(), after = d.after.profiles();
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i]->flat()) {
      flat += fmt::format("{}{}", flat.empty() ? "" : ", ", before[i]->axis);
    } else {
      plots.push_back(profile_plot(*before[i], *after[i]));
    }
  }
  if (!plots.empty()) page.plots(plots, 2);
  const auto numbered = std::find_if(d.before.axes.begin(), d.before.axes.end(),
                                     [](const AxisMap& map) { return !map.flat() && !map.names.empty(); });
  if (numbered != d.before.axes.end()) {
    std::string names;
    for (std::size_t i = 0; i < numbered->names.size(); ++i)
      names += fmt::format("{}{} is {}", i == 0 ? "" : ", ", i, numbered->names[i]);
    page.note("On the axis of recordings " + names + ".");
  }
  if (!flat.empty()) page.note("Looked at and flat: " + flat + ".");
  if (d.before.repeat_z != 0) {
    page.note(
        fmt::format("Repeats of the same reference have {:.0f} % of the smoothed error in common ({:.1f} "
                    "standard errors).",
                    100 * std::max(0.0, d.before.repeat_correlation), d.before.repeat_z));
  }
}

}  // namespace cartwright
