#include "host/identify/shape_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cartwright {
namespace {

struct Axis {
  Parameter parameter;
  std::vector<double> grid;
  double least, most;  ///< the search stays within
};

std::vector<double> linear(double from, double to, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(from + (to - from) * i / (count - 1));
  return out;
}

std::vector<double> geometric(double from, double to, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i)
    out.push_back(from * std::pow(to / from, static_cast<double>(i) / (count - 1)));
  return out;
}

Axis axis_of(Parameter parameter, const DataRange& range) {
  const double travel_m = std::max(range.most_m - range.least_m, 1e-9);
  switch (parameter) {
    case Parameter::exponential_alpha2:
      return {parameter, geometric(0.3 / range.speed_m_per_s, 60 / range.speed_m_per_s, 24), 0,
              1e3 / range.speed_m_per_s};
    case Parameter::stribeck_speed:
      return {parameter, geometric(0.01 * range.speed_m_per_s, range.speed_m_per_s, 20),
              1e-3 * range.speed_m_per_s, 10 * range.speed_m_per_s};
    case Parameter::spot_centre:
      return {parameter, linear(range.least_m, range.most_m, 25), range.least_m, range.most_m};
    case Parameter::spot_width:
      return {parameter, geometric(0.02 * travel_m, 0.3 * travel_m, 6), 1e-3 * travel_m, travel_m};
    case Parameter::cogging_period: {
      // Two periods are told apart over the travel when their cycles differ by half of one.
      std::vector<double> grid;
      for (double cycles = 1; cycles < std::max(8.0, travel_m / 1.5e-3); cycles += 0.25) {
        grid.push_back(travel_m / cycles);
      }
      return {parameter, grid, 1e-4 * travel_m, 2 * travel_m};
    }
    case Parameter::dead_zone_half_width:
      return {parameter, linear(0, 0.5 * range.voltage_V, 16), 0, 0.9 * range.voltage_V};
    case Parameter::saturation_limit:
      return {parameter, linear(0.2 * range.voltage_V, range.voltage_V, 17), 1e-3 * range.voltage_V,
              range.voltage_V};
    case Parameter::armature_time_constant:
      return {parameter, geometric(0.3 * range.period_s, 100 * range.period_s, 16), 0, 1};
    case Parameter::transport_delay:
      return {parameter, linear(0, 30 * range.period_s, 16), 0, 0.1};
    case Parameter::heating_time_constant:
      return {parameter, geometric(0.1 * range.longest_s, 10 * range.longest_s, 10), 0.02 * range.longest_s,
              100 * range.longest_s};
    default:
      return {parameter, {0}, 0, 0};
  }
}

/// How many candidates one sweep tries: the shapes of one term, neighbours in the list, together.
double candidates_on_grids(const std::vector<Axis>& axes) {
  double all = 0, of_term = 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    of_term *= static_cast<double>(axes[i].grid.size());
    if (i + 1 < axes.size() && info(axes[i + 1].parameter).term == info(axes[i].parameter).term) continue;
    all += of_term;
    of_term = 1;
  }
  return all;
}

/// Nelder and Mead (1965) in scaled coordinates.
std::vector<double> descend(std::vector<double> start, const std::vector<double>& scale,
                            const std::function<double(const std::vector<double>&)>& cost) {
  const std::size_t size = start.size();
  std::vector<std::vector<double>> points(size + 1, start);
  for (std::size_t i = 0; i < size; ++i) points[i + 1][i] += scale[i];
  std::vector<double> costs;
  for (const auto& point : points) costs.push_back(cost(point));
  for (int round = 0; round < 80 * static_cast<int>(size); ++round) {
    std::vector<std::size_t> order(size + 1);
    for (std::size_t i = 0; i <= size; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
    const std::size_t best = order.front(), worst = order.back(), second = order[size - 1];
    if (costs[worst] - costs[best] <= 1e-9 * std::abs(costs[best])) break;
    std::vector<double> centre(size, 0.0);
    for (std::size_t i = 0; i <= size; ++i) {
      if (i == worst) continue;
      for (std::size_t j = 0; j < size; ++j) centre[j] += points[i][j] / static_cast<double>(size);
    }
    const auto along = [&](double by) {
      std::vector<double> point(size);
      for (std::size_t j = 0; j < size; ++j) point[j] = centre[j] + by * (points[worst][j] - centre[j]);
      return point;
    };
    const auto take = [&](std::vector<double> point, double value) {
      points[worst] = std::move(point);
      costs[worst] = value;
    };
    const auto reflected = along(-1);
    const double reflected_cost = cost(reflected);
    if (reflected_cost < costs[best]) {
      const auto expanded = along(-2);
      const double expanded_cost = cost(expanded);
      if (expanded_cost < reflected_cost) {
        take(expanded, expanded_cost);
      } else {
        take(reflected, reflected_cost);
      }
    } else if (reflected_cost < costs[second]) {
      take(reflected, reflected_cost);
    } else {
      const auto inside = along(reflected_cost < costs[worst] ? -0.5 : 0.5);
      const double inside_cost = cost(inside);
      if (inside_cost < std::min(reflected_cost, costs[worst])) {
        take(inside, inside_cost);
      } else {
        for (std::size_t i = 0; i <= size; ++i) {
          if (i == best) continue;
          for (std::size_t j = 0; j < size; ++j) points[i][j] = 0.5 * (points[i][j] + points[best][j]);
          costs[i] = cost(points[i]);
        }
      }
    }
  }
  return points[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())];
}

}  // namespace

Model search_shapes(const std::vector<Parameter>& shapes, const DataRange& range,
                    const std::function<double(const Model&)>& cost,
                    const std::function<void(double)>& progress) {
  Model best;
  std::vector<Axis> axes;
  for (const Parameter shape : shapes) {
    axes.push_back(axis_of(shape, range));
    best.set(shape, axes.back().grid[axes.back().grid.size() / 2]);
  }
  std::vector<double> scale(axes.size(), 0.0);
  const int sweeps = axes.size() > 1 ? 2 : 1;
  const double total = sweeps * candidates_on_grids(axes);
  double tried = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t first = 0; first < axes.size();) {
      // The shapes of one term (neighbours in the list) are searched together.
      std::size_t last = first + 1;
      while (last < axes.size() && info(axes[last].parameter).term == info(axes[first].parameter).term)
        ++last;
      std::vector<std::size_t> at(last - first, 0);
      double least = std::numeric_limits<double>::infinity();
      Model candidate = best;
      while (true) {
        for (std::size_t i = first; i < last; ++i)
          candidate.set(axes[i].parameter, axes[i].grid[at[i - first]]);
        const double value = cost(candidate);
        if (progress) progress(++tried / total);
        if (value < least) {
          least = value;
          best = candidate;
          for (std::size_t i = first; i < last; ++i) {
            const std::vector<double>& grid = axes[i].grid;
            const std::size_t k = std::min(at[i - first] + 1, grid.size() - 1);
            scale[i] = 0.4 * (k > 0 ? std::abs(grid[k] - grid[k - 1]) : 1.0);
          }
        }
        std::size_t i = 0;
        while (i < at.size() && ++at[i] == axes[first + i].grid.size()) at[i++] = 0;
        if (i == at.size()) break;
      }
      first = last;
    }
  }
  std::vector<double> start;
  for (const Axis& axis : axes) start.push_back(best[axis.parameter]);
  const auto model_at = [&](const std::vector<double>& point) {
    Model model = best;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      model.set(axes[i].parameter, std::clamp(point[i], axes[i].least, axes[i].most));
    }
    return model;
  };
  return model_at(
      descend(start, scale, [&](const std::vector<double>& point) { return cost(model_at(point)); }));
}

}  // namespace cartwright
