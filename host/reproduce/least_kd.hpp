#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Section 4.4, Eq. (85): at Kp = 100 the least Kd for which the response settles to 1 % within 0.5 s, for
/// Lm3 and NLm3, by a scan over all Kd: the set that settles in time is not an interval, so that a bisection
/// over Kd finds one of its edges, whichever (ERRATA).
Result<Section> least_derivative_gain(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
