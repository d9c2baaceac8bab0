#pragma once

#include <numbers>

namespace cartwright {

/// One turn, rad.
inline constexpr double kTwoPi = 2 * std::numbers::pi;

}  // namespace cartwright
