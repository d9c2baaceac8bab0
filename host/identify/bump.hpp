#pragma once

#include <algorithm>

namespace cartwright {

/// The test function of the weak form, on the window |t - centre| < half:
///
///     p(t) = (1 - s^2)^3,   s = (t - centre)/half,   zero outside.
///
/// p and p' vanish at the ends, so that integrating by parts twice moves both derivatives of y onto p and
/// leaves no start state to be estimated.
struct Bump {
  double centre_s = 0, half_s = 1;

  double value(double t_s) const {
    const double s = clamped(t_s), q = 1 - s * s;
    return q * q * q;
  }

  /// Integral of p over the whole window [s].
  double area_s() const { return half_s * 32.0 / 35.0; }

 private:
  double clamped(double t_s) const { return std::clamp((t_s - centre_s) / half_s, -1.0, 1.0); }
};

}  // namespace cartwright
