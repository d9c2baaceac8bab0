#pragma once

#include <span>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

/// C(v) = alpha1 exp(-alpha2 |v|) + gamma, Eq. (67) of Wongvanich, Hann and Sirisena (2015), in the speed |v|
/// (ERRATA, Eq. 66).
struct DampingLaw {
  double alpha1_per_s = 0, alpha2_s_per_m = 0, gamma_per_s = 0;
  double at(double speed_m_per_s) const;
};

/// Fits the law to damping values at mean speeds, Eq. (68)-(71): for a given gamma the logarithm is a
/// straight line in the speed, and F(gamma), the sum of squares that is left, is minimised over 0 <= gamma <
/// min C. Fails for fewer than three points, and where the damping does not fall with speed.
Result<DampingLaw> fit_damping_law(std::span<const double> speed_m_per_s,
                                   std::span<const double> damping_per_s);

}  // namespace cartwright
