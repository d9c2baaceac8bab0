#include "host/diagnose/search/evolve_gap.hpp"

#include <algorithm>
#include <cmath>

#include "host/diagnose/search/evolution.hpp"
#include "host/diagnose/search/mass_share.hpp"
#include "host/diagnose/search/some_recordings.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kSlowCorrelation_s = 0.003;
/// First steps: of the mass's share along the way that it can hardly be told on, of what else the teeth have,
/// and of all other numbers as a part of themselves.
constexpr double kStepOfShare = 0.1, kStepOfTeeth = 0.05, kStepOfRest = 0.01;

/// So many steps away from a model, within bounds.
Model moved(const Model& from, const std::vector<FreeParameter>& free, const Eigen::VectorXd& steps) {
  Model to = from;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double by = steps[static_cast<Eigen::Index>(i)];
    if (free[i].id == P::backlash_load_share)
      to = with_share(to, std::clamp(from[free[i].id] + kStepOfShare * by, free[i].lower, free[i].upper));
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    const FreeParameter& p = free[i];
    if (p.id == P::backlash_load_share) continue;
    const double by = steps[static_cast<Eigen::Index>(i)], here = to[p.id];
    const bool teeth = info(p.id).term == Term::backlash;
    const double size = teeth ? kStepOfTeeth : kStepOfRest;
    const double scale = teeth ? 1 : std::max(std::abs(here), 0.1 * p.scale);
    const double there = p.logarithmic ? here * std::exp(size * by) : here + size * scale * by;
    to.set(p.id, std::clamp(there, p.lower, p.upper));
  }
  return to;
}

}  // namespace

NoiseModel sharp(NoiseModel noise, double share_of_disturbance) {
  noise.disturbance_per_reading_per_s2 *= share_of_disturbance;
  noise.correlation_time_s = std::max(noise.correlation_time_s, kSlowCorrelation_s);
  return noise;
}

Model evolve_gap(const Session& session, const Model& from, const NoiseModel& noise,
                 const std::vector<FreeParameter>& free, FitOptions options, const EvolutionEffort& effort,
                 unsigned threads) {
  const Session some = one_of_each_kind(session, effort.most_data_s);
  options.threads = 1;
  const auto cost = [&](const Eigen::VectorXd& steps) {
    return -log_likelihood(counted_errors(some, moved(from, free, steps), noise, options), options.outlier_m);
  };
  EvolutionOptions search;
  search.threads = threads;
  search.most_evaluations = effort.most_evaluations;
  const auto numbers = static_cast<Eigen::Index>(free.size());
  return moved(from, free, evolve(cost, Eigen::VectorXd::Zero(numbers), search));
}

Fit evolved_gap(const Session& session, Fit found, double worth_going_on, int most_times,
                const FitOptions& options, unsigned threads) {
  for (int time = 0; time < most_times; ++time) {
    const Model start = evolve_gap(session, found.model, sharp(found.noise, kFinerDisturbance), found.free,
                                   options, kGapNear, threads);
    Fit further = fit(session, start, found.noise, found.free, options);
    const double better = further.log_likelihood - found.log_likelihood;
    if (better > 0) found = std::move(further);
    if (better < worth_going_on) break;
  }
  return found;
}

}  // namespace cartwright
