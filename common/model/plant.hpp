#pragma once

#include "common/model/delay_line.hpp"
#include "common/model/model.hpp"
#include "common/model/plant_terms.hpp"

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
  double step_s = 2.5e-4;          ///< greatest inner step; stiff terms choose a smaller one by themselves
  bool disturbance_active = true;  ///< whether this recording is the one with the external disturbance
  double heating_start_s = 0;      ///< time_s at which the motor was cold
  /// Multiplies the step that stiff terms choose. Observers, corrected every tick, do well with 3.
  double stiff_step_factor = 1;
  /// Makes two masses linear for each inner step h, so that they take a series as others do: what changes
  /// with place or time counts as it is half way through, what bends with speed by its tangent, the drive by
  /// a line. Of a wave of wavenumber k that leaves out (k v h)^2/24, of a law f of speed f'' (a h)^2/6. A
  /// presliding bristle and rigid contact are integrated all the same. For observers.
  bool linear_by_steps = false;
};

/// The cart,
///
///     d2y/dt2 = beta u - sum(opposing terms) + sum(pushes)            [m/s^2]
///
/// Viscous and Coulomb friction with constant pushes are solved in closed form, two masses with them by a
/// Taylor series; everything else is integrated by the classical fourth-order Runge-Kutta method. All of it
/// between events. Friction is discontinuous at v = 0 and nothing is smoothed: the zero crossing of the
/// velocity is located inside the step, the velocity set to exactly zero there, and the mass then stays still
/// for as long as the net force is within the breakaway level. Holds for any step size. A presliding bristle
/// is elastic until it carries the breakaway level, then slides, and is elastic again from the next
/// standstill; by Dahl's or LuGre's law it gives all along (plant_dahl.cpp). With backlash or a flexible
/// coupling there are two masses, each with its own friction and its own sticking; backlash contact is rigid
/// and its impacts are inelastic, unless its teeth give. Constant push, cogging, spring and disturbance act
/// on the cart, the drive on the motor.
///
/// Order of the input chain: dead zone, saturation, gain asymmetry, delay, lag, current limit.
/// No allocation, no exception; copying copies the whole state.
class Plant {
 public:
  explicit Plant(const Model& model, const PlantOptions& options = {});

  /// Starts from `state`. Until the first delayed command arrives, the voltage in `state.armature_V` acts.
  void reset(const PlantState& state);
  /// Starts at rest at a position.
  void reset(double position_m, double velocity_m_per_s = 0, double time_s = 0);

  const PlantState& state() const { return state_; }

  /// Puts the cart at another position and speed; the motor moves along.
  void correct(double position_m, double velocity_m_per_s);

  /// Puts both masses elsewhere, as an observer does that keeps apart what it knows of them.
  void correct(double position_m, double velocity_m_per_s, double motor_position_m,
               double motor_velocity_m_per_s);

  /// Holds `command_V` for `duration_s`; `push_m_per_s2` is an added acceleration of the cart.
  void advance(double command_V, double duration_s, double push_m_per_s2 = 0) noexcept;

 private:
  /// The motor's push at the start, in the middle and at the end of a step, and the armature's voltage at its
  /// end.
  struct Drive {
    double start, middle, end;
    double armature_V;
  };

  void find_contact() noexcept;
  void hold(double shaped_V, double duration_s) noexcept;
  void hold_linear(double duration_s) noexcept;
  void hold_one_mass(double duration_s) noexcept;
  void hold_dahl(double duration_s) noexcept;
  void hold_two_masses(double duration_s) noexcept;
  void hold_two_masses_linear(double duration_s) noexcept;
  Drive drive(double duration_s) const noexcept;
  /// One mass after a step, and its acceleration at the start of it.
  struct OneMass {
    double position_m, velocity_m_per_s, start_rate;
    Drive drive;
  };
  template <typename Rate>
  OneMass one_mass_after(double duration_s, const Rate& rate) const noexcept;
  template <typename Moves>
  double release_s(double duration_s, const Moves& moves) const noexcept;

  PlantTerms terms_;
  bool series_;  // two masses that are linear, at least by steps
  double step_s_, apart_step_s_, heating_start_s_;
  PlantState state_;
  double target_V_ = 0;  // voltage the armature moves towards in this hold
  double extra_push_ = 0;
  DelayLine delay_line_;
  double delayed_V_ = 0;
};

}  // namespace cartwright
