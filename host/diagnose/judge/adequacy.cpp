#include "host/diagnose/judge/adequacy.hpp"

#include <algorithm>

#include "host/diagnose/locate/where.hpp"

namespace cartwright {
namespace {

/// A regression on fixed errors sees only what the observer's inflated noise lets through; refitted with the
/// noise free, effects gained 4 to 7 times what it promised (measured over all terms on simulated carts).
constexpr double kGainOverPromise = 5.0;
constexpr double kHardlyLeftOfWindows = 0.05;

}  // namespace

double excess_left(const Errors& errors, double floor_m) {
  const double floor = floor_m * floor_m;
  const double before = errors.refitted * errors.refitted - floor;
  const double after = errors.with_effects * errors.with_effects - floor;
  return before > 0 ? std::clamp(after / before, 0.0, 1.0) : 1.0;
}

double nats_left(const Location& after) {
  return kGainOverPromise * structure_left(after);
}

double likelihood_left(const Location& after, const Search& search) {
  const double left = nats_left(after);
  const double gained = std::max(search.best.score() - search.refitted.score(), 0.0);
  return left > 0 ? left / (left + gained) : 0;
}

bool too_much_left(double of_windows, double of_likelihood, const std::vector<Support>& effects) {
  if (of_windows > kMostLeftOfWindows) return true;
  if (of_likelihood <= kMostLeftOfLikelihood) return false;
  return effects.size() != 1 || !effects.front().most_say_so() || of_windows > kHardlyLeftOfWindows;
}

}  // namespace cartwright
