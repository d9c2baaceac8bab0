#include "host/diagnose/search/race_beside_gap.hpp"

#include <algorithm>

#include "host/diagnose/search/evolve_gap.hpp"

namespace cartwright {
namespace {

constexpr EvolutionEffort kHeat{kGapFar.most_data_s, kGapFar.most_evaluations / 3};
constexpr EvolutionEffort kFinal{kGapFar.most_data_s, kGapFar.most_evaluations - kHeat.most_evaluations};

}  // namespace

std::vector<Fit> race_beside_gap(const Session& session, const std::vector<Promise>& promises,
                                 double worth_going_on, const FitOptions& sketch, unsigned threads) {
  const auto fitted = [&](const Model& from, const Promise& promise) {
    return fit(session, from, kSharpNoise, promise.free, sketch);
  };
  const auto evolved = [&](const Model& from, const Promise& promise, const EvolutionEffort& effort) {
    return fitted(evolve_gap(session, from, kSharpNoise, promise.free, sketch, effort, threads), promise);
  };
  std::vector<Fit> fits;
  for (const Promise& promise : promises) {
    Fit slopes = fitted(promise.start, promise), moved = evolved(promise.start, promise, kHeat);
    fits.push_back(slopes.log_likelihood > moved.log_likelihood ? std::move(slopes) : std::move(moved));
  }
  const auto first = std::max_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
    return a.log_likelihood < b.log_likelihood;
  });
  if (first == fits.end() || first->log_likelihood < worth_going_on) return fits;
  Fit further = evolved(first->model, promises[static_cast<std::size_t>(first - fits.begin())], kFinal);
  if (further.log_likelihood > first->log_likelihood) *first = std::move(further);
  return fits;
}

}  // namespace cartwright
