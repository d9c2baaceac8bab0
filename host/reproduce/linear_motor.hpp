#pragma once

#include "host/reproduce/reproduction.hpp"
#include "host/reproduce/tracking.hpp"

namespace cartwright::reproduce {

/// The linear motor of the relay paper: Table 1 (Kf 10.5 N/A, R 1.5 Ohm, Ke 10.5 V s/m, 0.59 kg) and the
/// friction identified in its Section 6, f1 = 0.238 V and f2 = 0.00062 V s/m.
struct LinearMotor {
  static constexpr double kKf = 10.5, kR_Ohm = 1.5, kKe = 10.5, kMass_kg = 0.59, kPeakCurrent_A = 20;
  static constexpr double kF1_V = 0.238, kF2 = 0.00062;
  /// Eq. (40).
  static constexpr double kKv = 1200, kLambda1 = 600, kLambda2 = 1400;

  static constexpr double inertia() { return kMass_kg * kR_Ohm / kKf; }  ///< b of Eq. (6)
  static Model model(double friction = 1);
  /// 0.5 Hz under the PD part of Eq. (24), (25) with Eq. (40), 5 kHz, an encoder of 1 um without noise.
  static TrackingSetup tracking(CompensationMode mode, const Model& known);
};

/// Section 5: the adaptive law from nothing, from a fair and from a good model.
Result<Section> adaptive_starts(const ReproduceOptions& options);

/// Section 6: tracking error without and with friction compensation.
Result<Section> linear_motor(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
