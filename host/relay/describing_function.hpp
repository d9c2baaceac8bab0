#pragma once

#include <optional>
#include <span>

#include "common/result.hpp"

namespace cartwright {

/// What one dual-relay experiment gives: relay amplitudes and the first harmonic of its limit cycle.
struct RelayFeature {
  double h1_V = 0, h2_V = 0;
  double amplitude_m = 0;
  double frequency_rad_per_s = 0;
};

/// G(s) = Kp/(s (Tp s + 1)) from voltage to position with friction (f1 + f2 |v|) sgn(v), in volts. What
/// position and voltage can tell:
struct RelayCombinations {
  double tp_over_kp = 0;          ///< Tp/Kp [V s^2/m], 1/beta
  double f1_V = 0;                ///< Coulomb level
  double inverse_kp_plus_f2 = 0;  ///< 1/Kp + f2 [V s/m]
};

/// Corrected describing-function equations. From N(a) G(j w) = -1 with
/// N(a) = 4 h1/(pi a) + j (4 (f1 - h2)/(pi a) + w f2):
///
///     h1 = (pi/4) a w^2 Tp/Kp              h2 = f1 + (pi/4) a w (1/Kp + f2)                     [V]
///
/// in least squares over all experiments; at least two with different a w. (Tan, Lee and others, Eq. 15; the
/// viscous term is w f2 and not f2, ERRATA, so that f2 and 1/Kp enter as their sum and only so.) Biased by 1
/// to 7 %: the describing function leaves the harmonics out.
Result<RelayCombinations> corrected_describing_function(std::span<const RelayFeature> experiments);

struct RelayFourParameters {
  double kp = 0, tp_s = 0, f1_V = 0, f2 = 0;
};

/// The equations as printed, with f2 in place of w f2:
///
///     h1 = (pi/4) a w^2 Tp/Kp              h2 = f1 + (pi/4) a f2 + (pi/4) a w/Kp
///
/// in least squares over three experiments or more. They seem to tell Kp from f2; that is an artefact of the
/// missing w.
Result<RelayFourParameters> published_describing_function(std::span<const RelayFeature> experiments);

/// Eq. (17) as printed, for two experiments: Kp and Tp from the first with friction neglected, then f1 and
/// f2.
Result<RelayFourParameters> published_equation_17(const RelayFeature& first, const RelayFeature& second);

}  // namespace cartwright
