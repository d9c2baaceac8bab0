#pragma once

#include <vector>

#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// Fits of several promises on top of a model with a gap, whose numbers were found without them. Slopes
/// seldom lead from there to what they are beside them: every promise also evolves for a while, with all its
/// numbers, and the best of them to the end, if its log-likelihood is `worth_going_on` by then. A fit for
/// each promise, in their order; `sketch` says how far each is fitted.
std::vector<Fit> race_beside_gap(const Session& session, const std::vector<Promise>& promises,
                                 double worth_going_on, const FitOptions& sketch, unsigned threads);

}  // namespace cartwright
