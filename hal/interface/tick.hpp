#pragma once

#include <cstdint>

namespace cartwright::hal {

/// The moment a tick happens, on the loop's clock (CLOCK_MONOTONIC, or virtual). Every call of one tick gets
/// the same.
struct Tick {
  std::int64_t now_ns = 0;     ///< when the loop woke up
  std::int64_t period_ns = 0;  ///< measured since the tick before; the nominal period at the first
};

}  // namespace cartwright::hal
