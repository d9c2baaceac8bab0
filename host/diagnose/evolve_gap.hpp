#pragma once

#include <vector>

#include "host/diagnose/fit.hpp"

namespace cartwright {

/// All free numbers of a model with a gap, looked for by evolution from where they are, the noise held: teeth
/// that meet and part make so many local bests, so close to each other, that slopes mislead. On some 20 s of
/// the session; `free` holds the parameters, with their bounds.
Model evolve_gap(const Session& session, const Model& from, const NoiseModel& noise,
                 const std::vector<FreeParameter>& free, FitOptions options, unsigned threads);

}  // namespace cartwright
