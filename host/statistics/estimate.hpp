#pragma once

#include <cmath>
#include <limits>

namespace cartwright {

/// A number found from data with its 95 % interval. Bounds are NaN where the data gives none.
struct Estimate {
  double value = 0;
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();

  bool has_interval() const { return std::isfinite(low) && std::isfinite(high); }
  static Estimate within(double value, double half_width) {
    return {value, value - half_width, value + half_width};
  }
};

}  // namespace cartwright
