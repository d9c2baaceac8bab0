#pragma once

#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// Which rows of each recording tell no more than that the cart rests: for some time before and after them
/// all readings lie within one count q of one another. Friction hides the disturbance there and rounding says
/// the same again and again, so such rows are no measure of the noise. The time is
///
///     t = 5 sqrt(2 q / a),   a = v^2 / (2 L)
///
/// five times what a slow acceleration takes over a count, one that reaches the greatest speed v of the
/// session over its whole travel L (`MotionRange`). 28 ms for 23 um, 0.35 m and 1 m/s. None where the rig
/// tells no count.
std::vector<std::vector<bool>> rows_at_rest(const Session& session);

}  // namespace cartwright
