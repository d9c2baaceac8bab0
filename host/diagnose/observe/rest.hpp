#pragma once

#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// For how long a cart stays within one count q of its encoder before it is said to rest,
///
///     t = 5 sqrt(2 q / a),   a = v^2 / (2 L)
///
/// five times what a slow acceleration takes over a count, one that reaches the speed v of a session over its
/// travel L (`MotionRange`). 28 ms for 23 um, 0.35 m and 1 m/s. Zero where the rig tells no count.
double time_at_rest_s(const Session& session);

/// Which rows of each recording tell no more than that the cart rests: for that time before and after them
/// all readings lie within one count of one another. Friction hides the disturbance there and rounding says
/// the same again and again, so such rows are no measure of the noise. None where the time is zero.
std::vector<std::vector<bool>> rows_at_rest(const Session& session, double time_s);

}  // namespace cartwright
