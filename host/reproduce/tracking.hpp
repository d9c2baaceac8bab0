#pragma once

#include <cstdint>
#include <functional>

#include "common/control/compensation.hpp"
#include "common/control/pid.hpp"

namespace cartwright::reproduce {

/// A sine to be followed by a simulated machine under the PD or PID law, with or without compensation.
struct TrackingSetup {
  Model truth{1.9};
  PdGains gains{80, 3, 50, false};
  double ki_V_per_m_s = 0;
  CompensationSettings compensation;
  double period_s = 1e-3, duration_s = 20, voltage_limit_V = 12;
  double amplitude_m = 0.1, frequency_hz = 0.5;
  double encoder_step_m = 1e-6;
  double noise_m = 0;  ///< standard deviation of what is added to every reading, before rounding
  std::uint64_t seed = 1;
  /// From this time on the machine is `later`; never where it is not before `duration_s`.
  double change_s = 1e9;
  Model later{1.9};
};

struct TrackingResult {
  double error_rms_m = 0;           ///< reference less true position, over the last half
  double measured_error_rms_m = 0;  ///< reference less reading, as an experimenter sees it
  double variation_V_per_s = 0;     ///< sum of |u_k - u_(k-1)| per second over the last half: chatter
  AdaptiveEstimates least, greatest, last;
  std::uint16_t limits_met = 0;
};

/// The run in virtual time. The sine fades in over its first period. `watch`, where given, sees every tick's
/// time, reference, reading and voltage.
TrackingResult track(const TrackingSetup& setup,
                     const std::function<void(double, double, double, double)>& watch = {});

}  // namespace cartwright::reproduce
