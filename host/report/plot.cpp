#include "host/report/plot.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/data_pool.hpp"

namespace cartwright::report {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Mark mark) {
  switch (mark) {
    case Mark::line:
      return "line";
    case Mark::step:
      return "step";
    case Mark::points:
      return "points";
    case Mark::band:
      return "band";
    case Mark::bars:
      return "bars";
  }
  return "line";
}

const char* name_of(Colour colour) {
  switch (colour) {
    case Colour::automatic:
      return "automatic";
    case Colour::measured:
      return "measured";
    case Colour::reference:
      return "reference";
    case Colour::model:
      return "model";
    case Colour::other_model:
      return "other_model";
    case Colour::truth:
      return "truth";
    case Colour::warning:
      return "warning";
    case Colour::fourth:
      return "fourth";
    case Colour::muted:
      return "muted";
  }
  return "automatic";
}

Json axis_json(const Axis& axis) {
  Json out{{"label", axis.label}, {"unit", axis.unit}};
  if (axis.logarithmic) out["log"] = true;
  if (!axis.categories.empty()) out["categories"] = axis.categories;
  if (axis.least) out["least"] = *axis.least;
  if (axis.greatest) out["greatest"] = *axis.greatest;
  return out;
}

Json series_json(const Series& series, std::size_t budget, DataPool& pool) {
  Json out{{"name", series.name}, {"mark", name_of(series.mark)}, {"colour", name_of(series.colour)}};
  if (series.dashed) out["dashed"] = true;
  if (!series.shown) out["shown"] = false;
  if (series.mark == Mark::bars) out["width"] = series.bar_width;
  const bool is_path = series.mark == Mark::line || series.mark == Mark::step;
  const bool ordered = std::is_sorted(series.x.begin(), series.x.end());
  if (is_path && ordered && series.low.empty()) {
    Thinned thin = without_straight_runs(series.x, series.y);
    // Thinning costs the sharing of x with the other series of the same recording: only where it pays.
    if (3 * thin.x.size() > series.x.size()) thin = {series.x, series.y};
    thin = least_and_greatest(thin.x, thin.y, budget);
    out["x"] = pool.add(thin.x);
    out["y"] = pool.add(thin.y);
    return out;
  }
  const std::size_t stride = std::max<std::size_t>(1, (series.x.size() + budget - 1) / budget);
  const auto every = [&](const std::vector<double>& values) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < values.size(); i += stride) kept.push_back(values[i]);
    return pool.add(kept);
  };
  out["x"] = every(series.x);
  if (!series.y.empty()) out["y"] = every(series.y);
  if (!series.low.empty()) out["low"] = every(series.low);
  if (!series.high.empty()) out["high"] = every(series.high);
  return out;
}

Json heat_map_json(const HeatMap& map, DataPool& pool) {
  Json out{{"name", map.name},
           {"unit", map.unit},
           {"columns", map.columns},
           {"rows", map.rows},
           {"x", {map.x_least, map.x_greatest}},
           {"y", {map.y_least, map.y_greatest}},
           {"values", pool.add(map.values)}};
  if (map.diverging) out["diverging"] = true;
  if (map.least) out["least"] = *map.least;
  if (map.greatest) out["greatest"] = *map.greatest;
  return out;
}

}  // namespace

std::string to_json(const Plot& plot, DataPool& pool) {
  Json out{
      {"title", plot.title}, {"x", axis_json(plot.x)}, {"y", axis_json(plot.y)}, {"height", plot.height_px}};
  if (!plot.linked.empty()) out["linked"] = plot.linked;
  if (plot.square) out["square"] = true;
  const std::size_t budget = kPointsPerPlot / std::max<std::size_t>(1, plot.series.size());
  out["series"] = Json::array();
  for (const Series& series : plot.series) out["series"].push_back(series_json(series, budget, pool));
  if (plot.heat_map) out["heat_map"] = heat_map_json(*plot.heat_map, pool);
  for (const Guide& guide : plot.guides) {
    out["guides"].push_back(
        {{"at", guide.at == Guide::Along::x ? "x" : "y"}, {"value", guide.value}, {"name", guide.name}});
  }
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Series histogram(std::string name, const std::vector<double>& values, std::size_t bins) {
  Series out;
  out.name = std::move(name);
  out.mark = Mark::bars;
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  if (finite.empty() || bins == 0) return out;
  const auto [least, greatest] = std::minmax_element(finite.begin(), finite.end());
  const double start = *least;
  const double width = *greatest > start ? (*greatest - start) / static_cast<double>(bins) : 1;
  out.bar_width = width;
  out.y.assign(bins, 0);
  for (std::size_t i = 0; i < bins; ++i) out.x.push_back(start + width * (static_cast<double>(i) + 0.5));
  for (const double value : finite) {
    out.y[std::min(bins - 1, static_cast<std::size_t>((value - start) / width))] += 1;
  }
  return out;
}

}  // namespace cartwright::report
