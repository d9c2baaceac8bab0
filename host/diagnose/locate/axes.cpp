#include "host/diagnose/locate/axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cartwright {
namespace {

constexpr double kUnusable = std::numeric_limits<double>::quiet_NaN();

using Columns = std::vector<std::vector<double>>;

/// Edges that split the usable values into bins of equal counts; equal values stay together.
std::vector<double> even_edges(const Columns& values, std::size_t bins) {
  std::vector<double> all;
  for (const auto& column : values) {
    for (const double v : column) {
      if (!std::isnan(v)) all.push_back(v);
    }
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  std::vector<double> edges{all.front()};
  for (std::size_t i = 1; i < bins; ++i) {
    const double edge = all[i * (all.size() - 1) / bins];
    if (edge > edges.back()) edges.push_back(edge);
  }
  if (all.back() > edges.back()) edges.push_back(all.back());
  return edges;
}

AxisBins binned(std::string axis, std::string parity, const Columns& values, std::vector<double> edges,
                const std::vector<std::vector<signed char>>& direction, std::vector<std::string> names = {}) {
  AxisBins bins{std::move(axis), std::move(parity), std::move(edges), {}, direction, std::move(names)};
  for (const auto& column : values) {
    std::vector<int> rows(column.size(), -1);
    for (std::size_t k = 0; k < column.size(); ++k) {
      if (std::isnan(column[k]) || bins.edges.size() < 2) continue;
      const auto above = std::upper_bound(bins.edges.begin() + 1, bins.edges.end() - 1, column[k]);
      rows[k] = static_cast<int>(above - bins.edges.begin()) - 1;
    }
    bins.bin.push_back(std::move(rows));
  }
  return bins;
}

}  // namespace

std::vector<AxisBins> axes_of(const Session& session, const std::vector<Observation>& seen,
                              std::size_t bins) {
  const std::size_t count = session.recordings.size();
  Columns time(count), which(count), position(count), velocity(count), acceleration(count), voltage(count),
      reversal(count), everywhere(count);
  std::vector<std::vector<signed char>> even(count), odd(count);
  for (std::size_t n = 0; n < count; ++n) {
    const Recording& r = session.recordings[n];
    const std::vector<double>& v = seen[n].velocity_m_per_s;
    const std::size_t rows = r.size();
    for (auto* column : {&time[n], &which[n], &position[n], &velocity[n], &acceleration[n], &voltage[n],
                         &reversal[n], &everywhere[n]}) {
      column->assign(rows, kUnusable);
    }
    even[n].assign(rows, 1);
    odd[n].assign(rows, 0);
    double turned_at = r.y_m.front(), last_sign = 0;
    for (std::size_t k = 1; k < rows; ++k) {
      if (v[k] == 0) continue;  // stuck: no push would show
      const double sign = v[k] > 0 ? 1 : -1;
      if (sign != last_sign) turned_at = r.y_m[k - 1], last_sign = sign;
      odd[n][k] = static_cast<signed char>(-sign);
      time[n][k] = r.t_s[k] - r.t_s.front();
      which[n][k] = static_cast<double>(n);
      position[n][k] = r.y_m[k - 1];
      velocity[n][k] = v[k];
      voltage[n][k] = r.u_V[k - 1];
      reversal[n][k] = std::abs(r.y_m[k - 1] - turned_at);
      everywhere[n][k] = sign;
      acceleration[n][k] = seen[n].acceleration_m_per_s2[k];
    }
  }
  std::vector<double> recordings{-0.5};
  std::vector<std::string> files;
  for (std::size_t n = 0; n < count; ++n) {
    recordings.push_back(static_cast<double>(n) + 0.5);
    files.push_back(session.recordings[n].file);
  }
  std::vector<AxisBins> axes;
  const auto add = [&](const char* name, const char* parity, const Columns& values) {
    const bool is_odd = std::string_view(parity) == "odd";
    axes.push_back(binned(name, parity, values, even_edges(values, bins), is_odd ? odd : even));
  };
  add("time_s", "even", time);
  add("time_s", "odd", time);
  axes.push_back(binned("recording", "even", which, recordings, even, files));
  axes.push_back(binned("recording", "odd", which, recordings, odd, files));
  add("position_m", "even", position);
  add("position_m", "odd", position);
  add("velocity_m_per_s", "even", velocity);
  add("acceleration_m_per_s2", "even", acceleration);
  add("voltage_V", "even", voltage);
  add("voltage_V", "odd", voltage);
  axes.push_back(binned("direction", "even", everywhere, {-1.5, 0, 1.5}, even));
  add("after_reversal_m", "odd", reversal);
  return axes;
}

}  // namespace cartwright
