#pragma once

#include <Eigen/Dense>

#include "common/model/model.hpp"
#include "host/diagnose/observe/noise.hpp"

namespace cartwright {

/// Kalman gain of a cart that its motor moves through teeth with a gap, from the covariance of the errors of
///
///     x = (y, v, y_motor, v_motor, d):   cart, motor and the disturbance acceleration that acts on the cart,
///
/// in units of the reading error. In the gap the two move apart from each other and a reading says little of
/// the motor; in contact they move as one: their speeds are the common one (what teeth make of two speeds in
/// a tick) and their distance is known. Without it a reading taken in the gap misleads the motor, and the
/// likelihood of a session full of reversals has its maximum at wrong gaps.
class TwoMassGain {
 public:
  /// `count_m`: size of the encoder's steps, the unit of what is not known of the motor at the start.
  TwoMassGain(const Model& model, const NoiseModel& noise, double period_s, double damping_per_s,
              double count_m);

  /// Takes one tick. Returns the gain and, in `error_variance_ratio`, the variance of the one-step error.
  struct Gain {
    double position, velocity_per_s, motor_position, motor_velocity_per_s, disturbance_per_s2;
    double error_variance_ratio;
  };
  Gain step(bool in_contact);

  void restart();
  double disturbance_decay() const { return decay_; }

 private:
  // Of the five a sixth is always zero: whole packets reckon faster.
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  // How the speeds and the disturbance move all; of the positions it is known.
  using Movers = Eigen::Matrix<double, 6, 3>;

  Movers apart_, together_;
  Matrix start_, p_;
  double decay_, disturbance_variance_, motor_variance_;
  Gain gain_{};
  bool in_contact_ = false, steady_ = false;  // steady: the covariance no longer moves in this mode
};

}  // namespace cartwright
