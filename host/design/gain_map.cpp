#include "host/design/gain_map.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "host/parallel.hpp"

namespace cartwright::design {
namespace {

constexpr std::size_t kCoarse = 4;
constexpr double kClose = 0.1;  // slack worth a closer look

double along(const GainRange& range, std::size_t i, std::size_t count) {
  if (count < 2) return range.least;
  return range.least + (range.most - range.least) * static_cast<double>(i) / static_cast<double>(count - 1);
}

/// The lattice points of a coarser stride around one: up to two along each side.
std::array<std::size_t, 2> around(std::size_t i, std::size_t stride) {
  const std::size_t low = i / stride * stride;
  return {low, i % stride == 0 ? low : low + stride};
}

}  // namespace

GainMap::GainMap(const Trials& trials, GainRange kp, GainRange kd, IntegralPart integral,
                 std::size_t quarters, unsigned threads, const Progress& progress)
    : kp_(kp),
      kd_(kd),
      integral_(integral),
      columns_(kp.fixed() ? 1 : kCoarse * quarters + 1),
      rows_(kd.fixed() ? 1 : kCoarse * quarters + 1),
      points_(columns_ * rows_) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Gains& gains = points_[i].gains;
    gains.kp_V_per_m = along(kp, i % columns_, columns_);
    gains.kd_V_s_per_m = along(kd, i / columns_, rows_);
    gains.ki_V_per_m_s = integral.time_s > 0 ? gains.kp_V_per_m / integral.time_s : integral.ki_V_per_m_s;
  }
  double done = 0;
  for (std::size_t stride = kCoarse; stride > 0; stride /= 2) {
    auto which = worth_trying(stride);
    // In portions, so that the progress moves.
    constexpr std::size_t kPortion = 256;
    const std::size_t count = which.size();
    for (std::size_t first = 0; first < count; first += kPortion) {
      const auto from = which.begin() + static_cast<std::ptrdiff_t>(first);
      const auto to = which.begin() + static_cast<std::ptrdiff_t>(std::min(count, first + kPortion));
      try_points({from, to}, trials, threads);
      if (progress)
        progress(done + (1.0 / 3) * static_cast<double>(to - which.begin()) / static_cast<double>(count));
    }
    done += 1.0 / 3;
  }
}

std::vector<std::size_t> GainMap::worth_trying(std::size_t stride) const {
  std::vector<std::size_t> which;
  const MapPoint* best = nullptr;
  for (const MapPoint& point : points_) {
    if (point.tried && (!best || point.verdict.slack > best->verdict.slack)) best = &point;
  }
  const std::size_t best_at = best ? static_cast<std::size_t>(best - points_.data()) : 0;
  for (std::size_t row = 0; row < rows_; row += stride) {
    for (std::size_t column = 0; column < columns_; column += stride) {
      const std::size_t at = row * columns_ + column;
      if (points_[at].tried) continue;
      if (stride == kCoarse) {
        which.push_back(at);
        continue;
      }
      // Between points of twice the stride: interesting where they differ, come close or one of them is best.
      std::size_t tried = 0, met = 0, held = 0;
      bool interesting = false;
      for (const std::size_t r : around(row, 2 * stride)) {
        for (const std::size_t c : around(column, 2 * stride)) {
          const MapPoint& corner = points_[r * columns_ + c];
          if (!corner.tried) continue;
          ++tried;
          met += corner.verdict.met();
          held += corner.holds();
          interesting = interesting || std::abs(corner.verdict.slack) < kClose || r * columns_ + c == best_at;
        }
      }
      const bool differ = (met > 0 && met < tried) || (held > 0 && held < tried);
      if (interesting || differ) which.push_back(at);
    }
  }
  return which;
}

void GainMap::try_points(const std::vector<std::size_t>& which, const Trials& trials, unsigned threads) {
  std::atomic<std::size_t> hint{0};
  parallel_for(which.size(), threads, [&](std::size_t i) {
    MapPoint& point = points_[which[i]];
    point.metrics = trials.metrics(trials.scenarios.front(), point.gains);
    point.verdict = judge(trials.specification, point.metrics);
    if (point.verdict.met()) {
      std::size_t first = hint;
      point.worst = trials.meets(point.gains, trials.mapped, first);
      hint = first;
    }
    point.tried = true;
  });
}

std::size_t GainMap::tried() const {
  return static_cast<std::size_t>(
      std::count_if(points_.begin(), points_.end(), [](const MapPoint& p) { return p.tried; }));
}

template <typename Value, typename Of, typename Mean>
std::vector<Value> GainMap::filled(Of of, Mean mean) const {
  std::vector<Value> out(points_.size());
  std::vector<char> known(points_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].tried) continue;
    out[i] = of(points_[i]);
    known[i] = 1;
  }
  for (std::size_t stride = kCoarse / 2; stride > 0; stride /= 2) {
    for (std::size_t row = 0; row < rows_; row += stride) {
      for (std::size_t column = 0; column < columns_; column += stride) {
        const std::size_t at = row * columns_ + column;
        if (known[at]) continue;
        std::array<Value, 4> corners{};
        std::size_t count = 0;
        for (const std::size_t r : around(row, 2 * stride)) {
          for (const std::size_t c : around(column, 2 * stride)) corners[count++] = out[r * columns_ + c];
        }
        out[at] = mean(corners);
        known[at] = 1;
      }
    }
  }
  return out;
}

std::vector<double> GainMap::filled_slack() const {
  return filled<double>([](const MapPoint& p) { return std::clamp(p.verdict.slack, -1.0, 1.0); },
                        [](const std::array<double, 4>& c) { return 0.25 * (c[0] + c[1] + c[2] + c[3]); });
}

std::vector<char> GainMap::filled_holds() const {
  return filled<char>([](const MapPoint& p) { return p.holds() ? char{1} : char{0}; },
                      [](const std::array<char, 4>& c) {
                        return static_cast<char>(c[0] != 0 && c[1] != 0 && c[2] != 0 && c[3] != 0);
                      });
}

Outline outline(const GainMap& map, const std::vector<char>& inside) {
  // Every side of a cell between inside and outside, from corner to corner, the inside on its left: so each
  // corner that is reached is left again, and walking on closes a loop.
  using Corner = std::pair<std::size_t, std::size_t>;
  std::multimap<Corner, Corner> sides;
  const auto is_in = [&](std::size_t column, std::size_t row) {
    // One beyond each edge, below zero too, is outside.
    return column < map.columns() && row < map.rows() && inside[row * map.columns() + column] != 0;
  };
  for (std::size_t row = 0; row < map.rows(); ++row) {
    for (std::size_t column = 0; column < map.columns(); ++column) {
      if (!is_in(column, row)) continue;
      const Corner a{column, row}, b{column + 1, row}, c{column + 1, row + 1}, d{column, row + 1};
      if (!is_in(column, row - 1)) sides.emplace(a, b);
      if (!is_in(column + 1, row)) sides.emplace(b, c);
      if (!is_in(column, row + 1)) sides.emplace(c, d);
      if (!is_in(column - 1, row)) sides.emplace(d, a);
    }
  }
  const auto place = [](const GainRange& range, std::size_t corner, std::size_t count) {
    const double step = (range.most - range.least) / static_cast<double>(std::max<std::size_t>(count - 1, 1));
    return range.least + (static_cast<double>(corner) - 0.5) * step;
  };
  Outline out;
  const auto add = [&](const Corner& corner, bool ends) {
    out.x.push_back(place(map.kp(), corner.first, map.columns()));
    out.y.push_back(ends ? std::numeric_limits<double>::quiet_NaN()
                         : place(map.kd(), corner.second, map.rows()));
  };
  while (!sides.empty()) {
    const Corner start = sides.begin()->first;
    Corner at = start;
    add(at, false);
    do {
      const auto side = sides.find(at);
      at = side->second;
      sides.erase(side);
      add(at, false);
    } while (at != start);
    add(at, true);
  }
  return out;
}

}  // namespace cartwright::design
