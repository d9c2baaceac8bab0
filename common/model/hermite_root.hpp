#pragma once

#include <algorithm>
#include <cmath>

namespace cartwright {

/// Where an event happens inside a step: the root in (0, 1] of the cubic through (0, p0) with slope d0 and
/// (1, p1) with slope d1, p0 and p1 of opposite signs. With p0 = 0 the root at 0 is divided out and the next
/// one given. Newton steps kept inside a shrinking bracket; third order in the step.
inline double hermite_root(double p0, double d0, double p1, double d1) noexcept {
  const double c2 = 3 * (p1 - p0) - 2 * d0 - d1;
  const double c3 = 2 * (p0 - p1) + d0 + d1;
  const bool divided = p0 == 0;
  const auto value = [&](double x) {
    return divided ? d0 + x * (c2 + x * c3) : p0 + x * (d0 + x * (c2 + x * c3));
  };
  const auto slope = [&](double x) { return divided ? c2 + 2 * c3 * x : d0 + x * (2 * c2 + 3 * c3 * x); };
  double low = 0, high = 1;
  double x = divided ? 0.5 : std::clamp(p0 / (p0 - p1), 0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const double here = value(x);
    if ((here > 0) == (p1 > 0)) {
      high = x;
    } else {
      low = x;
    }
    const double down = slope(x);
    double next = down != 0 ? x - here / down : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-14) break;
    x = next;
  }
  return x;
}

}  // namespace cartwright
