#pragma once

#include <utility>
#include <vector>

#include "host/diagnose/search/scan.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

/// Whether steps of the reading are what lost counts would be: at least three, nearly all against the
/// motion, and at a rate: what else looks like one, a blow that the model misjudges, comes in crowds.
bool like_lost_counts(const Session& session, const std::vector<ReadingJump>& jumps);

/// Burst [counts], rate [1/s] and speed [m/s] of lost counts, read off the bursts themselves; also set in
/// `model`. `session` is the repaired one. The rate is that of a Poisson process while faster than the
/// slowest burst.
std::vector<std::pair<Parameter, Estimate>> lost_counts(const Session& session,
                                                        const std::vector<ReadingJump>& jumps, Model& model);

}  // namespace cartwright
