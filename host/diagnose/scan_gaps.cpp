#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/diagnose/mass_share.hpp"
#include "host/diagnose/scan.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kRatioOfGaps = 1.2;
constexpr double kLittleData_s = 12, kMostData_s = 30;
constexpr double kFastestReversals_per_s = 12;
/// A fit that lacks a gap calls its impacts disturbance; with that much of it no gap would show.
constexpr double kMostDisturbance_per_s2 = 3e4;
constexpr double kFinerDisturbance = 0.33;  // once the size is found
constexpr int kIterationsOfSketch = 4, kIterationsOfSize = 8, kIterationsOfShare = 4;
constexpr std::size_t kLinesKept = 2;  // once sketched
constexpr std::size_t kStartsKept = 2;
constexpr std::array kShares{0.3, 0.4, 0.5, 0.6, 0.7};

/// Reversals of the velocity over 10 ms, per second.
double reversals_per_s(const Recording& r, const Rig& rig) {
  const auto span = static_cast<std::size_t>(std::max(1.0, 0.01 * rig.sample_rate_hz));
  const double least_m = 3 * rig.encoder_resolution_m;
  int reversals = 0;
  double last = 0;
  for (std::size_t k = span; k < r.size(); k += span) {
    const double moved = r.y_m[k] - r.y_m[k - span];
    if (std::abs(moved) <= least_m) continue;
    reversals += last * moved < 0;
    last = moved;
  }
  return reversals / std::max(r.t_s.back() - r.t_s.front(), rig.period_s());
}

/// A share of the session that shows what a gap does: no repeats, most reversals first, but not so many that
/// one impact runs into the next.
Session some_of(const Session& session, double most_s) {
  struct Choice {
    std::size_t recording;
    double reversals_per_s;
  };
  std::vector<Choice> order;
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    if (!session.recordings[n].repeat_of.empty()) continue;
    order.push_back({n, reversals_per_s(session.recordings[n], session.rig)});
  }
  const auto crowded = [](const Choice& c) { return c.reversals_per_s > kFastestReversals_per_s; };
  std::stable_sort(order.begin(), order.end(), [&](const Choice& a, const Choice& b) {
    return crowded(a) != crowded(b) ? crowded(b) : a.reversals_per_s > b.reversals_per_s;
  });
  Session some;
  some.rig = session.rig;
  double length_s = 0;
  for (const Choice& choice : order) {
    const Recording& r = session.recordings[choice.recording];
    some.recordings.push_back(r);
    length_s += r.t_s.back() - r.t_s.front();
    if (length_s >= most_s) break;
  }
  return some;
}

/// Starts with the mass in equal parts: gaps along a line, one line for each way friction and damping may be
/// parted.
std::vector<std::vector<Model>> lines(const Model& from, const SessionFacts& facts) {
  const double count = facts.count_m > 0 ? facts.count_m : 1e-4 * facts.travel_m();
  std::vector<std::vector<Model>> all;
  for (const double friction_share : {0.35, 0.6, 0.85}) {
    for (const double damping_share : {0.2, 0.45}) {
      std::vector<Model>& line = all.emplace_back();
      for (double gap = 2 * count; gap < 0.03 * facts.travel_m(); gap *= kRatioOfGaps) {
        line.push_back(Model(from)
                           .set(P::backlash_gap, gap)
                           .set(P::backlash_load_share, 0.5)
                           .set(P::backlash_load_friction_share, friction_share)
                           .set(P::backlash_load_damping_share, damping_share)
                           .set(P::backlash_contact_resonance, 250)
                           .set(P::backlash_contact_damping_ratio, 0.2));
      }
    }
  }
  return all;
}

void sort_best_first(std::vector<Fit>& fits) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const Fit& a, const Fit& b) { return a.log_likelihood > b.log_likelihood; });
}

}  // namespace

std::vector<Promise> scan_gaps(const Session& session, const Fit& base, const Promise& from,
                               const SessionFacts& facts, const FitOptions& options, unsigned threads) {
  std::vector<FreeParameter> free = from.free;
  std::erase_if(free, [](const FreeParameter& p) { return p.id == P::backlash_load_share; });
  FitOptions quick = options;
  quick.most_rounds = 1;
  quick.move_noise = false;
  quick.covariance = false;
  const auto refined = [&](const Session& some, const std::vector<Model>& starts, const NoiseModel& noise) {
    std::vector<Fit> fits(starts.size());
    parallel_for(starts.size(), threads,
                 [&](std::size_t i) { fits[i] = fit(some, starts[i], noise, free, quick); });
    sort_best_first(fits);
    return fits;
  };

  NoiseModel noise = base.noise;
  noise.disturbance_per_reading_per_s2 =
      std::min(noise.disturbance_per_reading_per_s2, kMostDisturbance_per_s2);

  // The size, with the mass in equal parts.
  const Session little = some_of(session, kLittleData_s);
  const std::vector<std::vector<Model>> all = lines(from.start, facts);
  std::vector<Model> starts(all.size());
  parallel_for(all.size(), threads, [&](std::size_t i) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Model& one : all[i]) {
      const double value = log_likelihood(counted_errors(little, one, noise, options), options.outlier_m);
      if (value > most) most = value, starts[i] = one;
    }
  });
  quick.most_iterations = kIterationsOfSketch;
  const std::vector<Fit> sketched = refined(little, starts, noise);
  starts.clear();
  for (std::size_t i = 0; i < std::min(kLinesKept, sketched.size()); ++i) starts.push_back(sketched[i].model);
  quick.most_iterations = kIterationsOfSize;
  const Fit best = refined(little, starts, noise).front();
  const double most_share = kShares.back();
  if (with_share(best.model, most_share)[P::backlash_gap] < session.rig.encoder_resolution_m) return {};

  // How the mass is parted: the rest stays nearly the same along the way.
  const Session more = some_of(session, kMostData_s);
  starts.clear();
  for (const double share : kShares) starts.push_back(with_share(best.model, share));
  quick.most_iterations = kIterationsOfShare;
  noise.disturbance_per_reading_per_s2 *= kFinerDisturbance;
  std::vector<Promise> found;
  for (const Fit& one : refined(more, starts, noise)) {
    if (found.size() == kStartsKept) break;
    Promise promise = from;
    promise.start = one.model;
    promise.noise = one.noise;
    found.push_back(std::move(promise));
  }
  return found;
}

}  // namespace cartwright
