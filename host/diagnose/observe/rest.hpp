#pragma once

#include <vector>

#include "common/config/rig.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Which rows tell no more than that the cart rests: for some time before and after them all readings lie
/// within one count q of one another. Friction hides the disturbance there and rounding says the same again
/// and again, so such rows are no measure of the noise. The time is 10 s sqrt(q / 1 m), five times what
/// 0.5 m/s^2 take over a count (48 ms for 23 um). None where the rig tells no count.
std::vector<bool> rows_at_rest(const Rig& rig, const Recording& recording);

/// The same of each recording.
std::vector<std::vector<bool>> rows_at_rest(const Session& session);

}  // namespace cartwright
