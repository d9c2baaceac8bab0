#pragma once

#include <algorithm>

namespace cartwright {

/// Holds a value within +-limit.
inline double clip(double value, double limit) noexcept {
  return std::clamp(value, -limit, limit);
}

}  // namespace cartwright
