#pragma once

#include "common/control/pid.hpp"
#include "common/identify/moving_rows.hpp"
#include "common/model/plant.hpp"

namespace cartwright {

/// The closed loop of a model without noise and without disturbance, run beside the rig from the same
/// reference and the same added voltage. Its movement is what the regression takes as instrument: what shakes
/// the rig goes through the controller into the rig's voltage, and not into the twin's. A twin that has
/// drifted apart from the rig (more than 15 % of the movement, over two seconds) is not used; rows are left
/// out then, for up to twenty seconds, as equations without an instrument would bring the bias back. No
/// allocation, no exception in what runs inside a tick.
class Twin {
 public:
  Twin(double period_s, double voltage_limit_V);

  /// The model from now on; the movement goes on. Not positive: no twin.
  void set_model(double gain_m_per_s2_V, double viscous_per_s, double coulomb_m_per_s2) noexcept;
  /// A new recording under a PD or PID law, from rest.
  void begin(const PidGains& gains) noexcept;
  /// No law that the twin knows.
  void end() noexcept { running_ = false; }

  /// Puts the twin's state into the row and moves it on by a tick.
  void run(double reference_m, double added_V, OnlineRow& row) noexcept;

 private:
  double period_s_, voltage_limit_V_;
  bool modelled_ = false, running_ = false, first_ = true;
  Plant plant_;
  PidController law_;
  double apart_m2_ = 0, moved_m2_ = 0, middle_m_ = 0, apart_s_ = 0;
};

}  // namespace cartwright
