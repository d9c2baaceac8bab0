#pragma once

#include <span>

namespace cartwright::design {

/// What a step response is judged by. Times count from the step; z = (y - start)/step runs from 0 to 1.
struct StepMetrics {
  double settling_time_s = 0;  ///< |z - 1| stays within the band from here on; infinite where it does not
  double overshoot = 0;        ///< greatest z - 1, not below zero
  double rise_time_s = 0;      ///< from z = 0.1 to z = 0.9; infinite where 0.9 is not reached
  double rms_voltage_V = 0;    ///< of the command, over the whole test
  double peak_voltage_V = 0;   ///< greatest magnitude of the command
  double bandwidth_hz = 0;     ///< see bandwidth_hz(); NaN where it was not asked for
  double final_error = 0;      ///< z - 1 at the end of the test
};

/// Collects the metrics tick by tick. Band crossings are interpolated linearly between ticks, so that the
/// times are continuous in the gains as long as the response crosses the same edges.
class StepMeter {
 public:
  explicit StepMeter(double settling_band) : band_(settling_band) {}

  /// Where the cart is at a time after the step, and the command held from then for `held_s`.
  void add(double time_s, double z, double command_V, double held_s) noexcept;

  StepMetrics metrics() const;

 private:
  double band_;
  double last_time_s_ = 0, last_z_ = 0, first_time_s_ = 0;
  double settled_s_ = 0, tenth_s_ = -1, nine_tenths_s_ = -1;
  double greatest_ = 0, squares_V2_s_ = 0, peak_V_ = 0, held_s_ = 0;
  bool outside_ = true, first_ = true;
};

/// Closed-loop bandwidth [Hz] from the step response itself: the lowest frequency at which the Fourier
/// transform of the normalised velocity,
///
///     H(j w) = integral of z'(t) exp(-j w t) dt = sum of (z_(k+1) - z_k) exp(-j w (t_k + T/2)),
///
/// has fallen to 1/sqrt(2) of its magnitude at zero. For a linear loop that is the -3 dB frequency from
/// reference to position; for any other it is the one of this step size. `z` is sampled every `period_s`,
/// begins at rest and must have come to rest at its end: otherwise the result is NaN, and it is infinite
/// where half the sampling rate is not enough.
double bandwidth_hz(std::span<const double> z, double period_s);

}  // namespace cartwright::design
