#pragma once

#include <vector>

#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// Fits of promises on top of a model with a gap, `base`, greatest first. Slopes seldom lead to all the
/// numbers of both: every promise also evolves for a while, and the best of them further while it has not
/// gained `worth_going_on` and another step may bring it there. Seen from a gap that was moved to see them
/// (promises_beside_gap.hpp), terms promise more than they gain: once one has gained more than the next
/// promises, that and the rest have no fit. A fit for each of the others, in their order; `sketch` says how
/// far each is fitted.
std::vector<Fit> race_beside_gap(const Session& session, const Fit& base,
                                 const std::vector<Promise>& promises, double worth_going_on,
                                 const FitOptions& sketch, unsigned threads);

}  // namespace cartwright
