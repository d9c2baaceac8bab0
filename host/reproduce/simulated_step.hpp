#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/design/step_test.hpp"
#include "host/reproduce/published_carts.hpp"
#include "host/session/session.hpp"

namespace cartwright::reproduce {

/// The paper's experiment on a simulated cart: PD at 1 kHz, 12 V, a step of the reference to 0.1 m.
struct StepSetup {
  GainPair gains{60, 0};
  double duration_s = 0.9;          ///< after the step
  double before_s = 0.02;           ///< at rest, so that the derivative sees the reference jump
  double encoder_resolution_m = 0;  ///< zero: the exact position
  double noise_m = 0;               ///< standard deviation, added before the encoder rounds
  double reading_phase = 0;         ///< where in a count the cart starts, 0 to 1
  unsigned long seed = 1;
};

/// What the loop records; the controller acts on the noisy, rounded reading. One recording.
Session simulated_step(const Model& cart, const StepSetup& setup);

/// First row after the step.
std::size_t step_row(const Recording& recording);

/// A response as the paper computes it, Eq. (62): y'' + (C + beta Kd) y' + beta Kp y = beta Kp r0, the PD law
/// taken as continuous and unlimited, and without the derivative's kick (ERRATA: the amplifier clips).
struct IdealResponse {
  double period_s = 1e-3;
  std::vector<double> y_m, u_V;  ///< at 0, period, 2 period, ...
};
IdealResponse ideal_response(const Model& cart, GainPair gains, double duration_s);

/// A loop that is stepped as a transfer function of PD law and cart is: the derivative of the error, Eq.
/// (57), sees the step itself, and nothing limits or filters what it makes of it - an impulse, after which
/// the cart starts at beta Kd r0. Eq. (62) has left it out.
design::Loop stepped_transfer_function(double period_s);

}  // namespace cartwright::reproduce
