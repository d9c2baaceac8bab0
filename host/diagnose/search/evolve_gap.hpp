#pragma once

#include <vector>

#include "host/diagnose/fit/fit.hpp"

namespace cartwright {

/// How much of a session an evolution sees, and how often it asks for its likelihood.
struct EvolutionEffort {
  double most_data_s;
  int most_evaluations;
};

/// Near to where a gap's numbers are, to find them exactly.
inline constexpr EvolutionEffort kGapNear{18, 700};
/// Beside an effect that was missing so far they may be far, and everything else with them: on carts of our
/// own (draws 629, 634, 680, 741) 3000 evaluations over half the data came near to all four, 1500 over all of
/// it to one.
inline constexpr EvolutionEffort kGapFar{9, 2400};

/// Share of the disturbance that is left once a gap's size, or what is beside it, is in the model.
inline constexpr double kFinerDisturbance = 0.33;

/// The noise to look for a gap's numbers with: so much of the disturbance, and slower, so that what is sharp
/// in the errors is the gap's.
NoiseModel sharp(NoiseModel noise, double share_of_disturbance);

/// The same beside another effect, where the noise found so far holds all that the gap's numbers lack: on the
/// carts above searches with six times this disturbance ended where they began, with a fifth of it anywhere.
inline constexpr NoiseModel kSharpNoise{5e3, 0.003};

/// All free numbers of a model with a gap, looked for by evolution from where they are, the noise held: teeth
/// that meet and part make so many local bests, so close to each other, that slopes mislead. `free` holds the
/// parameters, with their bounds.
Model evolve_gap(const Session& session, const Model& from, const NoiseModel& noise,
                 const std::vector<FreeParameter>& free, FitOptions options, const EvolutionEffort& effort,
                 unsigned threads);

/// A fit whose numbers evolve and are fitted again, at most so many times, for as long as that gains
/// `worth_going_on` [nats]; never worse than `found`.
Fit evolved_gap(const Session& session, Fit found, double worth_going_on, int most_times,
                const FitOptions& options, unsigned threads);

}  // namespace cartwright
