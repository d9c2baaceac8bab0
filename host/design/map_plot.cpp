#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/design/design_page.hpp"

namespace cartwright::design {
namespace {

using namespace report;

constexpr double kShown = 50;  // per cent beyond which the colour stays the same

std::vector<double> over_limit(const GainMap& map) {
  std::vector<double> values = map.filled_slack();
  for (double& value : values) value *= -100;
  return values;
}

/// Outer edges of the cells around lattice points.
std::pair<double, double> edges(const GainRange& range, std::size_t count) {
  const double half =
      0.5 * (range.most - range.least) / static_cast<double>(std::max<std::size_t>(count - 1, 1));
  return {range.least - half, range.most + half};
}

Series outlined(const GainMap& map, const std::vector<char>& inside, std::string name, Colour colour) {
  Outline line = outline(map, inside);
  Series series{std::move(name), std::move(line.x), std::move(line.y)};
  series.colour = colour;
  return series;
}

/// Whether gains lie on this map: the same integral part, as far as it has one.
bool lies_on(const GainMap& map, const Gains& gains) {
  const IntegralPart part = map.integral();
  const double ki = part.time_s > 0 ? gains.kp_V_per_m / part.time_s : part.ki_V_per_m_s;
  return std::abs(ki - gains.ki_V_per_m_s) <= 1e-2 * std::max(ki, gains.ki_V_per_m_s);
}

Plot curve(const GainMap& map, bool over_kp) {
  Plot plot;
  plot.x = over_kp ? Axis{"Kp", "V/m"} : Axis{"Kd", "V s/m"};
  plot.y = {"over the tightest limit", "%"};
  plot.y.least = -kShown;
  plot.y.greatest = 2 * kShown;
  Series line{"model"}, holds{"met by every cart mapped"};
  line.y = over_limit(map);
  const auto inside = map.filled_holds();
  holds.mark = Mark::points;
  for (std::size_t i = 0; i < map.points().size(); ++i) {
    const Gains& gains = map.points()[i].gains;
    line.x.push_back(over_kp ? gains.kp_V_per_m : gains.kd_V_s_per_m);
    if (inside[i] == 0) continue;
    holds.x.push_back(line.x.back());
    holds.y.push_back(line.y[i]);
  }
  line.colour = Colour::model;
  holds.colour = Colour::truth;
  plot.add(line);
  if (!holds.x.empty()) plot.add(holds);
  plot.guides.push_back({Guide::Along::y, 0, "limit"});
  plot.height_px = 320;
  return plot;
}

}  // namespace

Plot map_plot(const DesignPage& content, const GainMap& map) {
  const std::string title =
      map.integral().time_s > 0         ? fmt::format("Ki = Kp/({:.3g} s)", map.integral().time_s)
      : map.integral().ki_V_per_m_s > 0 ? fmt::format("Ki = {:.4g} V/(m s)", map.integral().ki_V_per_m_s)
                                        : std::string();
  if (map.columns() == 1 || map.rows() == 1) {
    Plot plot = curve(map, map.rows() == 1);
    plot.title = map.rows() == 1 ? fmt::format("Kd = {:.4g} V s/m", map.kd().least)
                                 : fmt::format("Kp = {:.4g} V/m", map.kp().least);
    if (!title.empty()) plot.title += ", " + title;
    return plot;
  }
  Plot plot;
  plot.title = title;
  plot.x = {"Kp", "V/m"};
  plot.y = {"Kd", "V s/m"};
  plot.height_px = content.design.maps.size() > 1 ? 300 : 440;
  HeatMap heat;
  heat.name = "over the tightest limit";
  heat.unit = "%";
  heat.columns = map.columns();
  heat.rows = map.rows();
  std::tie(heat.x_least, heat.x_greatest) = edges(map.kp(), map.columns());
  std::tie(heat.y_least, heat.y_greatest) = edges(map.kd(), map.rows());
  heat.values = over_limit(map);
  heat.diverging = true;
  heat.least = -kShown;
  heat.greatest = kShown;
  plot.heat_map = heat;
  std::vector<char> met;
  for (const double slack : map.filled_slack()) met.push_back(slack >= 0 ? 1 : 0);
  const bool several = content.trials.scenarios.size() > 1;
  plot.add(outlined(map, met, several ? "met by the model" : "met", Colour::reference));
  if (several) {
    plot.add(outlined(map, map.filled_holds(), fmt::format("met by {} carts", content.trials.mapped),
                      Colour::measured));
  }
  Series rules{"tuning rules"}, here{content.design.found ? "proposed" : "nearest"};
  rules.mark = here.mark = Mark::points;
  rules.colour = Colour::fourth;
  here.colour = Colour::warning;
  for (const TuningRule& rule : content.rules.rules) {
    const Gains& g = rule.gains;
    if (!lies_on(map, g) && map.integral().time_s > 0) continue;
    if (g.kp_V_per_m > heat.x_greatest || g.kp_V_per_m < heat.x_least || g.kd_V_s_per_m > heat.y_greatest)
      continue;
    rules.x.push_back(g.kp_V_per_m);
    rules.y.push_back(g.kd_V_s_per_m);
  }
  if (!rules.x.empty()) plot.add(rules);
  if (lies_on(map, content.design.gains)) {
    here.x = {content.design.gains.kp_V_per_m};
    here.y = {content.design.gains.kd_V_s_per_m};
    plot.add(here);
  }
  return plot;
}

}  // namespace cartwright::design
