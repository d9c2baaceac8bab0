#pragma once

#include <vector>

#include "host/diagnose/fit/fit.hpp"

namespace cartwright {

/// Share of the disturbance that is left once a gap's size, or what is beside it, is in the model.
inline constexpr double kFinerDisturbance = 0.33;

/// The noise to look for a gap's numbers with: so much of the disturbance, and slower, so that what is sharp
/// in the errors is the gap's.
NoiseModel sharp(NoiseModel noise, double share_of_disturbance);

/// All free numbers of a model with a gap, looked for by evolution from where they are, the noise held: teeth
/// that meet and part make so many local bests, so close to each other, that slopes mislead. On some 20 s of
/// the session; `free` holds the parameters, with their bounds.
Model evolve_gap(const Session& session, const Model& from, const NoiseModel& noise,
                 const std::vector<FreeParameter>& free, FitOptions options, unsigned threads);

}  // namespace cartwright
