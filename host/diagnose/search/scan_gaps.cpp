#include <algorithm>
#include <cmath>
#include <limits>

#include "host/diagnose/search/evolve_gap.hpp"
#include "host/diagnose/search/mass_share.hpp"
#include "host/diagnose/search/scan.hpp"
#include "host/diagnose/search/some_recordings.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kRatioOfGaps = 1.2;
constexpr double kLittleData_s = 12;
/// A fit that lacks a gap calls its impacts disturbance; with that much of it no gap would show.
constexpr double kMostDisturbance_per_s2 = 3e4;
/// Once the gap's other numbers are found less of it is left.
constexpr double kFinestDisturbance = 0.5;
constexpr int kIterationsOfGapSketch = 4, kIterationsOfSize = 8;
constexpr std::size_t kLinesKept = 2;  // once sketched
constexpr double kMostShare = 0.7;     // of the mass, on the cart's side

/// Starts with the mass in equal parts: gaps along a line, one line for each way friction and damping may be
/// parted.
std::vector<std::vector<Model>> lines(const Model& from, const SessionFacts& facts) {
  const double count = facts.least_way_m();
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
                           .set(P::backlash_contact_resonance, 250 * facts.slower())
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

std::optional<Promise> scan_gaps(const Session& session, const Fit& base, const Promise& from,
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
  const Session little = most_reversals(session, kLittleData_s);
  const std::vector<std::vector<Model>> all = lines(from.start, facts);
  std::vector<Model> starts(all.size());
  parallel_for(all.size(), threads, [&](std::size_t i) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Model& one : all[i]) {
      const double value = log_likelihood(counted_errors(little, one, noise, options), options.outlier_m);
      if (value > most) most = value, starts[i] = one;
    }
  });
  quick.most_iterations = kIterationsOfGapSketch;
  const std::vector<Fit> sketched = refined(little, starts, noise);
  starts.clear();
  for (std::size_t i = 0; i < std::min(kLinesKept, sketched.size()); ++i) starts.push_back(sketched[i].model);
  quick.most_iterations = kIterationsOfSize;
  const Fit best = refined(little, starts, noise).front();
  if (with_share(best.model, kMostShare)[P::backlash_gap] < session.rig.encoder_resolution_m)
    return std::nullopt;

  // How the mass is parted, and all else about the gap: roughly, then with a disturbance that is smaller and
  // slower, so that what is sharp in the errors is the gap's.
  noise.disturbance_per_reading_per_s2 *= kFinerDisturbance;
  Promise found = from;
  found.start = evolve_gap(session, best.model, noise, from.free, options, kGapNear, threads);
  noise = sharp(noise, kFinestDisturbance);
  found.start = evolve_gap(session, found.start, noise, from.free, options, kGapNear, threads);
  found.noise = noise;
  return found;
}

}  // namespace cartwright
