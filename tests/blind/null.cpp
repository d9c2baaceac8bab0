#include "tests/blind/null.hpp"

#include <algorithm>

#include "host/diagnose/judge/surrogate.hpp"
#include "tests/blind/baselines/one_round.hpp"

namespace cartwright::blind {

std::vector<double> greatest_gains_of_nothing(const Session& clean, const Model& nominal,
                                              std::size_t surrogates, std::uint64_t seed) {
  const FitOptions options = options_for(clean, nominal);
  const Fit refitted = fit(clean, nominal, search_noise(clean, nominal, options),
                           free_parameters(nominal, facts_of(clean)), options);
  const NoiseSize noise = noise_size(refitted, clean.rig, options.damping_per_s);
  std::vector<double> gains;
  for (std::size_t i = 0; i < surrogates; ++i) {
    const OneRound round = one_round(surrogate(clean, refitted.model, noise, seed + i), nominal);
    double greatest = 0;  // of naming nothing
    for (const OneMore& one : round.tried) {
      // A push before its recording began is a start state that does not fit; the search drops it as well.
      const bool push = one.term == Term::external_disturbance;
      if (push && one.fit.model[Parameter::disturbance_start] < 0) continue;
      const double numbers =
          static_cast<double>(one.fit.free.size() - round.base.free.size() + 2 * one.jumps.size());
      greatest =
          std::max(greatest, one.fit.log_likelihood - round.base.log_likelihood - kCostPerNumber * numbers);
    }
    gains.push_back(greatest);
  }
  return gains;
}

}  // namespace cartwright::blind
