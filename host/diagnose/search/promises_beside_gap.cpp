#include "host/diagnose/search/promises_beside_gap.hpp"

#include "host/diagnose/search/evolve_gap.hpp"
#include "host/diagnose/search/promises.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr EvolutionEffort kLoosen{kGapFar.most_data_s, 1200};
constexpr struct {
  Term term;
  P size;
} kStandIns[] = {{Term::quadratic_drag, P::drag_coefficient},
                 {Term::asymmetric_viscous_friction, P::asymmetric_viscous_difference},
                 {Term::stribeck_friction, P::stribeck_excess}};
constexpr double kStribeckSpeed = 0.1;  // of the greatest

}  // namespace

std::vector<Promise> promises_beside_gap(const Session& session, const Fit& base, const SessionFacts& facts,
                                         const FitOptions& options, unsigned threads) {
  Model loose = base.model;
  std::vector<FreeParameter> free = base.free;
  for (const auto& [term, size] : kStandIns) {
    if (base.model.has(term)) continue;
    loose.set(size, 0);
    if (term == Term::stribeck_friction)
      loose.set(P::stribeck_speed, kStribeckSpeed * facts.most_speed_m_per_s);
    free.push_back(free_parameter(size, facts, loose));
  }
  loose = evolve_gap(session, loose, kSharpNoise, free, options, kLoosen, threads);
  loose = fit(session, loose, kSharpNoise, free, options).model;
  for (const auto& [term, size] : kStandIns) {
    if (!base.model.has(term)) loose.remove(term);
  }
  FitOptions as_it_is = options;
  as_it_is.most_iterations = 0;
  as_it_is.move_noise = false;
  as_it_is.covariance = true;  // for the slopes that promises are told apart from
  return all_promises(session, fit(session, loose, kSharpNoise, base.free, as_it_is), facts, options,
                      threads);
}

}  // namespace cartwright
