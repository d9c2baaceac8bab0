#include "host/diagnose/search/race_beside_gap.hpp"

#include "host/diagnose/search/evolve_gap.hpp"

namespace cartwright {
namespace {

constexpr EvolutionEffort kHeat{kGapFar.most_data_s, kGapFar.most_evaluations / 3};
constexpr EvolutionEffort kFinal{kGapFar.most_data_s, kGapFar.most_evaluations - kHeat.most_evaluations};

}  // namespace

std::vector<Fit> race_beside_gap(const Session& session, const Fit& base,
                                 const std::vector<Promise>& promises, double worth_going_on,
                                 const FitOptions& sketch, unsigned threads) {
  const auto fitted = [&](const Model& from, const Promise& promise) {
    return fit(session, from, kSharpNoise, promise.free, sketch);
  };
  const auto evolved = [&](const Model& from, const Promise& promise, const EvolutionEffort& effort) {
    return fitted(evolve_gap(session, from, kSharpNoise, promise.free, sketch, effort, threads), promise);
  };
  std::vector<Fit> fits;
  std::size_t first = 0;
  double gained = 0;
  for (const Promise& promise : promises) {
    if (gained > promise.log_likelihood_gain) break;
    Fit best = fitted(promise.start, promise);
    Fit moved = evolved(best.model, promise, kHeat);
    if (moved.log_likelihood > best.log_likelihood) best = std::move(moved);
    fits.push_back(std::move(best));
    if (fits.back().log_likelihood > fits[first].log_likelihood) first = fits.size() - 1;
    gained = fits[first].log_likelihood - base.log_likelihood;
  }
  if (fits.empty()) return fits;
  // What it lacks must be less than was promised, and then less than the step before brought.
  double step = promises[first].log_likelihood_gain;
  while (gained < worth_going_on && step > worth_going_on - gained) {
    Fit further = evolved(fits[first].model, promises[first], kFinal);
    if (further.log_likelihood > fits[first].log_likelihood) fits[first] = std::move(further);
    step = fits[first].log_likelihood - base.log_likelihood - gained;
    gained += step;
  }
  return fits;
}

}  // namespace cartwright
