#pragma once

#include <array>
#include <cstddef>

#include "common/model/model.hpp"

namespace cartwright {

/// Where the cart is and what its hidden parts hold. With one mass the motor's state equals the cart's.
struct PlantState {
  double position_m = 0;              ///< of the cart: the side the encoder is on
  double velocity_m_per_s = 0;        ///< exactly zero while the cart sticks
  double motor_position_m = 0;        ///< of the motor (backlash, flexible coupling)
  double motor_velocity_m_per_s = 0;  ///< exactly zero while the motor sticks
  double bristle_m = 0;               ///< presliding deflection, towards +y
  double armature_V = 0;              ///< output of the armature lag
  double time_s = 0;                  ///< time on the recording's clock
  int contact = 0;                    ///< backlash: +1 motor pushes towards +y, -1 towards -y, 0 in the gap
};

struct PlantOptions {
  double step_s = 2.5e-4;              ///< greatest inner step; stiff terms choose a smaller one by themselves
  bool disturbance_active = true;      ///< whether this recording is the one with the external disturbance
  double heating_start_s = 0;          ///< time_s at which the motor was cold
};

/// The cart,
///
///     d2y/dt2 = beta u - sum(opposing terms) + sum(pushes)            [m/s^2]
///
/// integrated by the classical fourth-order Runge-Kutta method between events. Friction is discontinuous at v = 0 and
/// nothing is smoothed: the zero crossing of the velocity is located inside the step (cubic Hermite root), the
/// velocity set to exactly zero there, and the mass then stays still for as long as the net force is within the
/// breakaway level. Holds for any step size. With backlash or a flexible coupling there are two masses, each with
/// its own friction and its own sticking; backlash contact is rigid and its impacts are inelastic.
///
/// Order of the input chain: delay, dead zone, saturation, gain asymmetry, lag, current limit.
/// No allocation, no exception; copying copies the whole state.
class Plant {
 public:
  explicit Plant(const Model& model, const PlantOptions& options = {});

  /// Starts from `state` with the armature settled at zero and no command in the delay line.
  void reset(const PlantState& state);
  /// Starts at rest at a position.
  void reset(double position_m, double velocity_m_per_s = 0, double time_s = 0);

  const PlantState& state() const { return state_; }

  /// Observers correct the cart's state between ticks; a change of velocity moves both masses.
  void correct(double position_m, double velocity_m_per_s);

  /// Holds `command_V` for `duration_s`; `push_m_per_s2` is an added acceleration of the cart.
  void advance(double command_V, double duration_s, double push_m_per_s2 = 0) noexcept;

 private:
  static constexpr std::size_t kDelayCapacity = 512;
  struct Rates {
    double cart, motor;
  };
  struct Switch {
    double time_s, voltage_V;
  };

  double static_map(double command_V) const noexcept;
  void hold(double shaped_V, double duration_s) noexcept;
  void hold_one_mass(double duration_s) noexcept;
  void hold_two_masses(double duration_s) noexcept;
  double drive(double time_s) const noexcept;
  double driven(double drive_m_per_s2, double velocity, double damping_share) const noexcept;
  double damping(double velocity) const noexcept;
  double level(double position, double velocity) const noexcept;
  double pushes(double position, double time_s) const noexcept;
  double one_mass_rate(double position, double velocity, double time_s, double sign) const noexcept;
  Rates two_mass_rates(const PlantState& s, double cart_sign, double motor_sign) const noexcept;
  double coupling_force(const PlantState& s) const noexcept;
  void join(PlantState& next) const noexcept;
  void settle_contact() noexcept;

  // The model, unpacked once: absent terms hold neutral values, flags skip what costs time.
  double beta_, viscous_, viscous_difference_, coulomb_;
  double alpha1_, alpha2_, gamma_;
  double stribeck_excess_, stribeck_inverse_speed_;
  double spot_peak_, spot_centre_, spot_inverse_width_;
  double constant_, cogging_amplitude_, cogging_wavenumber_, cogging_phase_;
  double spring_, spring_neutral_, drag_;
  double dead_zone_, saturation_, gain_difference_, current_limit_, lag_rate_, delay_;
  double heating_loss_, heating_rate_, heating_start_;
  double disturbance_start_, disturbance_duration_, disturbance_peak_;
  double bristle_stiffness_;
  double gap_, coupling_stiffness_, coupling_damping_;
  double load_share_, load_friction_share_, load_damping_share_;
  bool has_level_shape_, has_exponential_, has_cogging_, has_current_limit_, has_lag_, has_delay_, has_heating_,
      has_disturbance_, has_bristle_, two_masses_, rigid_backlash_;
  double step_s_;

  PlantState state_;
  double target_V_ = 0;  // voltage the armature moves towards in this hold
  double lag_start_V_ = 0, lag_start_s_ = 0;
  double extra_push_ = 0;
  std::array<Switch, kDelayCapacity> delay_line_{};
  std::size_t delay_head_ = 0, delay_count_ = 0;
  double delayed_V_ = 0;
};

}  // namespace cartwright
