#include "host/relay/limit_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/session/segments.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kLeastCycles = 4;
constexpr double kSettledBand = 0.03;
constexpr double kLastChange = 0.03, kChangeBefore = 0.06;
/// An oscillation that ends this small beside the largest excursion has died out.
constexpr double kDying = 0.02;
constexpr double kDriftPerCycle = 0.02, kWholeDrift = 0.1;
constexpr double kMostStill = 0.25;  ///< share of the time a limit cycle may stand still
/// A passage counts once the position has been this part of the half range to either side.
constexpr double kHysteresis = 0.1;

double reference(const Recording& recording, std::size_t row) {
  return recording.r_m.empty() ? 0.0 : recording.r_m[row];
}

/// Rows at which the position, less the reference, passes upward through zero.
std::vector<std::size_t> upward_passages(const Recording& recording, double band_m) {
  std::vector<std::size_t> rows;
  bool below = false;
  std::size_t candidate = 0;
  for (std::size_t row = 0; row < recording.size(); ++row) {
    const double y = recording.y_m[row] - reference(recording, row);
    if (y < -band_m) below = true;
    if (y < 0) candidate = row + 1;
    if (below && y > band_m) {
      rows.push_back(candidate);
      below = false;
    }
  }
  return rows;
}

/// When the last move by more than two encoder steps ended.
double last_motion_s(const Recording& recording, double still_m) {
  std::size_t row = recording.size() - 1;
  while (row > 0 && std::abs(recording.y_m[row] - recording.y_m.back()) <= still_m) --row;
  return recording.t_s[row];
}

/// Half of highest less lowest in the last fifth of the record.
double half_range_at_end(const Recording& recording) {
  const auto from =
      recording.y_m.begin() + static_cast<std::ptrdiff_t>(recording.size() - recording.size() / 5);
  const auto [low, high] = std::minmax_element(from, recording.y_m.end());
  return 0.5 * (*high - *low);
}

/// Share of [first, last) in which the position stays within `still_m` over 20 ms.
double still_share(const Recording& recording, std::size_t first, std::size_t last, double still_m) {
  constexpr double kLook_s = 0.02;
  std::size_t ahead = first, still = 0, looked = 0;
  for (std::size_t row = first; row < last; ++row) {
    while (ahead < last && recording.t_s[ahead] - recording.t_s[row] < kLook_s) ++ahead;
    if (ahead >= last) break;
    ++looked;
    if (std::abs(recording.y_m[ahead] - recording.y_m[row]) <= still_m) ++still;
  }
  return looked == 0 ? 0.0 : static_cast<double>(still) / static_cast<double>(looked);
}

/// Slope per cycle of a straight line through the values.
template <typename Value>
double change_per_cycle(const std::vector<Cycle>& cycles, std::size_t from, Value value) {
  const double n = static_cast<double>(cycles.size() - from), middle = 0.5 * (n - 1);
  double xx = 0, xy = 0;
  for (std::size_t i = from; i < cycles.size(); ++i) {
    const double x = static_cast<double>(i - from) - middle;
    xx += x * x;
    xy += x * value(cycles[i]);
  }
  return xy / xx;
}

Cycle measure(const Recording& recording, std::size_t first, std::size_t last) {
  Cycle cycle{first, last, recording.t_s[last] - recording.t_s[first], 0, 0};
  double low = 0, high = 0;
  for (std::size_t row = first; row < last; ++row) {
    const double y = recording.y_m[row] - reference(recording, row);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  cycle.amplitude_m = 0.5 * (high - low);
  cycle.offset_m = 0.5 * (high + low);
  return cycle;
}

}  // namespace

Result<LimitCycle> find_limit_cycle(const Recording& recording, const Rig& rig) {
  if (recording.size() < 100)
    return failure(fmt::format("{} rows; at least 100 are needed", recording.size()));
  if (const auto parts = segments(recording.t_s); parts.size() > 1) {
    return failure(
        fmt::format("rows are missing after t = {:.4g} s; a limit cycle needs a record without gaps",
                    recording.t_s[parts.front().last - 1]));
  }
  for (std::size_t row = 1; row < recording.r_m.size(); ++row) {
    if (recording.r_m[row] != recording.r_m[0]) {
      return failure(fmt::format("the reference changes at t = {:.4g} s; a limit cycle needs a constant one",
                                 recording.t_s[row]));
    }
  }
  const double still_m = 2 * rig.encoder_resolution_m;
  const auto [low, high] = std::minmax_element(recording.y_m.begin(), recording.y_m.end());
  const double half_range = 0.5 * (*high - *low);
  if (half_range <= 5 * rig.encoder_resolution_m) return failure("the cart does not move: it sticks");
  const double end_s = recording.t_s.back(), length_s = end_s - recording.t_s.front();
  const double stopped_s = last_motion_s(recording, still_m);
  if (end_s - stopped_s > 0.15 * length_s) {
    return failure(fmt::format(
        "the oscillation dies out and sticks at t = {:.3g} s; h2 must exceed the Coulomb friction",
        stopped_s));
  }
  const double end_m = half_range_at_end(recording);
  if (end_m < std::max(kDying * half_range, 5 * rig.encoder_resolution_m)) {
    return failure(
        fmt::format("the oscillation dies out: {:.3g} m at first, {:.3g} m in the end; h2 must exceed the "
                    "Coulomb friction",
                    half_range, end_m));
  }
  LimitCycle found;
  const auto passages = upward_passages(recording, kHysteresis * half_range);
  for (std::size_t i = 0; i + 1 < passages.size(); ++i) {
    found.cycles.push_back(measure(recording, passages[i], passages[i + 1]));
  }
  const auto& cycles = found.cycles;
  const std::size_t count = cycles.size();
  if (count < kLeastCycles) {
    return failure(
        fmt::format("{} whole cycles about the reference; at least {} are needed", count, kLeastCycles));
  }
  const double usual_m = 0.5 * (cycles[count - 1].amplitude_m + cycles[count - 2].amplitude_m);
  const double usual_s = 0.5 * (cycles[count - 1].period_s + cycles[count - 2].period_s);
  const double last_passage_s = recording.t_s[passages.back()];
  if (end_s - last_passage_s > 2 * usual_s) {
    return failure(fmt::format("the oscillation about the reference ends at t = {:.3g} s", last_passage_s));
  }
  std::size_t from = count - 2;
  while (from > 0 && std::abs(cycles[from - 1].period_s - usual_s) <= kSettledBand * usual_s &&
         std::abs(cycles[from - 1].amplitude_m - usual_m) <= kSettledBand * usual_m) {
    --from;
  }
  const auto changes = [&](std::size_t i, double most) {
    return std::abs(cycles[i].amplitude_m - cycles[i - 1].amplitude_m) > most * usual_m ||
           std::abs(cycles[i].period_s - cycles[i - 1].period_s) > most * usual_s;
  };
  if (changes(count - 1, kLastChange) || changes(count - 2, kChangeBefore)) {
    return failure(fmt::format(
        "the limit cycle has not converged: its last cycles have amplitudes {:.4g}, {:.4g} and "
        "{:.4g} m; a longer record is needed",
        cycles[count - 3].amplitude_m, cycles[count - 2].amplitude_m, cycles[count - 1].amplitude_m));
  }
  const auto offset = [](const Cycle& c) { return c.offset_m; };
  const double drift = change_per_cycle(cycles, std::min(from, count - 3), offset);
  if (std::abs(drift) > kDriftPerCycle * usual_m ||
      std::abs(drift) * static_cast<double>(count - from) > kWholeDrift * usual_m) {
    return failure(fmt::format("the oscillation drifts by {:.3g} m per cycle, {:.1f} % of its amplitude",
                               drift, 100 * drift / usual_m));
  }
  const double still = still_share(recording, cycles[from].first, cycles.back().last, still_m);
  if (still > kMostStill) {
    return failure(
        fmt::format("the cart sticks {:.0f} % of the time; larger relay amplitudes are needed", 100 * still));
  }
  found.settled_from = from;
  found.settled_s = recording.t_s[cycles[from].first];
  const std::size_t first = cycles[from].first, rows = cycles.back().last - first;
  const auto sine =
      sinefit(std::span(recording.t_s).subspan(first, rows), std::span(recording.y_m).subspan(first, rows),
              {.frequency_hz = {}, .harmonics = 5});
  if (!sine) return tl::unexpected(sine.error());
  found.sine = *sine;
  return found;
}

}  // namespace cartwright
