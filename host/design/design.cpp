#include "host/design/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "host/parallel.hpp"

namespace cartwright::design {
namespace {

using Candidates = std::vector<const MapPoint*>;

Candidates all_points(const std::vector<GainMap>& maps) {
  Candidates all;
  for (const GainMap& map : maps) {
    for (const MapPoint& point : map.points()) {
      if (point.tried) all.push_back(&point);
    }
  }
  return all;
}

/// Those that hold, the preferred first: with the margin by rms voltage, then by slack.
Candidates by_preference(const Candidates& all, double margin) {
  Candidates out;
  for (const MapPoint* point : all) {
    if (point->holds()) out.push_back(point);
  }
  std::stable_sort(out.begin(), out.end(), [margin](const MapPoint* a, const MapPoint* b) {
    const double left_a = a->worst.verdict.slack, left_b = b->worst.verdict.slack;
    const bool has_a = left_a >= margin, has_b = left_b >= margin;
    if (has_a != has_b) return has_a;
    return has_a ? a->worst.rms_voltage_V < b->worst.rms_voltage_V : left_a > left_b;
  });
  return out;
}

/// To four digits: nobody means more by a gain.
double rounded(double gain) {
  if (gain == 0) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(gain))) - 3);
  // By a whole number of units below one, so that the result prints short.
  return unit < 1 ? std::round(gain / unit) / std::round(1 / unit) : std::round(gain / unit) * unit;
}

/// All combinations of each gain a little more and a little less.
bool bears_change(const Trials& trials, const Gains& gains, double change, unsigned threads) {
  std::vector<Gains> changed;
  for (const double p : {1 - change, 1 + change}) {
    for (const double d : {1 - change, 1 + change}) {
      for (const double i : {1 - change, 1 + change}) {
        if (gains.ki_V_per_m_s == 0 && i > 1) continue;
        changed.push_back({p * gains.kp_V_per_m, d * gains.kd_V_s_per_m, i * gains.ki_V_per_m_s});
      }
    }
  }
  std::atomic<bool> holds{true};
  parallel_for(changed.size(), threads, [&](std::size_t k) {
    if (holds && !trials.all_meet(changed[k])) holds = false;
  });
  return holds;
}

void propose(Design& design, const Trials& trials, const SearchSettings& settings, const Candidates& all) {
  const Candidates preferred = by_preference(all, settings.margin);
  constexpr std::size_t kMostTried = 60;
  const MapPoint* chosen = nullptr;
  // Spread over the whole list: neighbours in it are neighbours on the map, and fail alike.
  const std::size_t stride = std::max<std::size_t>(1, preferred.size() / kMostTried);
  for (std::size_t k = 0; k < preferred.size() && !design.may_change; k += stride) {
    if (settings.progress)
      settings.progress("choosing", static_cast<double>(k) / static_cast<double>(preferred.size()));
    if (!trials.all_meet(preferred[k]->gains)) continue;
    if (!chosen) chosen = preferred[k];
    if (!bears_change(trials, preferred[k]->gains, settings.gain_change, settings.threads)) continue;
    chosen = preferred[k];
    design.may_change = true;
  }
  if (!chosen) return;
  design.found = true;
  design.gains = chosen->gains;
  Gains round = chosen->gains;
  if (!settings.kp.fixed()) round.kp_V_per_m = rounded(round.kp_V_per_m);
  if (!settings.kd.fixed()) round.kd_V_s_per_m = rounded(round.kd_V_s_per_m);
  if (settings.integrals.front().time_s > 0) round.ki_V_per_m_s = rounded(round.ki_V_per_m_s);
  if (trials.all_meet(round)) design.gains = round;
  const auto at_end = [](const GainRange& range, double gain) {
    return !range.fixed() && (gain == range.most || (gain == range.least && range.least > 0));
  };
  design.at_edge =
      at_end(settings.kp, chosen->gains.kp_V_per_m) || at_end(settings.kd, chosen->gains.kd_V_s_per_m);
}

/// The gains that come nearest: where the model meets it somewhere, of those the ones with the best worst
/// case.
void find_nearest(Design& design, const Trials& trials, const SearchSettings& settings, Candidates all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const MapPoint* a, const MapPoint* b) { return a->verdict.slack > b->verdict.slack; });
  design.model_alone = !all.empty() && all.front()->verdict.met();
  if (all.empty()) return;
  design.gains = all.front()->gains;
  if (!design.model_alone) return;
  constexpr std::size_t kMostTried = 100;
  all.resize(std::min(all.size(), kMostTried));
  std::vector<double> left(all.size());
  parallel_for(all.size(), settings.threads,
               [&](std::size_t k) { left[k] = trials.worst(all[k]->gains).verdict.slack; });
  const auto best = std::max_element(left.begin(), left.end()) - left.begin();
  design.gains = all[static_cast<std::size_t>(best)]->gains;
}

/// Of each limit: the best value of that quantity among points that keep all the others.
std::vector<Achievable> without_one(const Trials& trials, const Candidates& all) {
  std::vector<Achievable> out;
  for (const QuantityInfo& q : quantities()) {
    const auto& limit = trials.specification[q.id];
    if (!limit) continue;
    Specification others = trials.specification;
    others[q.id].reset();
    std::optional<double> best;
    for (const MapPoint* point : all) {
      const double value = point->metrics.*q.of;
      if (!std::isfinite(value) || !judge(others, point->metrics).met()) continue;
      if (!best || (q.at_least ? value > *best : value < *best)) best = value;
    }
    if (best) out.push_back({q.id, *limit, *best});
  }
  return out;
}

}  // namespace

SearchSettings default_search(const Model& model, const Loop& loop, const StepTest& step,
                              const Specification& specification, bool integral) {
  SearchSettings settings;
  const double beta = std::abs(model[Parameter::voltage_gain]);
  const double full_V_per_m = loop.voltage_limit_V / std::abs(step.step_m);
  settings.kp = {0.02 * full_V_per_m, 4 * full_V_per_m};
  settings.kd = {0, 3 * std::sqrt(settings.kp.most / beta)};
  if (!integral) return settings;
  const auto& asked = specification[Quantity::settling_time];
  const double settles_s = asked ? *asked : 0.25 * step.duration_s;
  settings.integrals.clear();
  for (const double times : {4.0, 2.0, 1.0, 0.5, 0.25}) settings.integrals.push_back({times * settles_s, 0});
  settings.quarters = 16;
  return settings;
}

Design search_gains(const Trials& trials, const SearchSettings& settings) {
  Design design;
  for (const IntegralPart& integral : settings.integrals) {
    const double done = static_cast<double>(design.maps.size()),
                 of = static_cast<double>(settings.integrals.size());
    design.maps.emplace_back(trials, settings.kp, settings.kd, integral, settings.quarters, settings.threads,
                             [&](double share) {
                               if (settings.progress) settings.progress("mapping", (done + share) / of);
                             });
  }
  const Candidates all = all_points(design.maps);
  propose(design, trials, settings, all);
  if (!design.found) {
    find_nearest(design, trials, settings, all);
    if (!design.model_alone) design.achievable = without_one(trials, all);
  }
  design.nominal = judge(trials.specification, trials.metrics(trials.scenarios.front(), design.gains));
  design.worst = trials.worst(design.gains).verdict;
  design.has_margin = design.found && design.worst.slack >= settings.margin;
  design.prediction = predict(trials, design.gains, settings.threads);
  return design;
}

}  // namespace cartwright::design
