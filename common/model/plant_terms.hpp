#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "common/model/model.hpp"

namespace cartwright {

inline double sign_of(double value) noexcept {
  return value > 0 ? 1.0 : (value < 0 ? -1.0 : 0.0);
}

/// e^-exponent of what fades away; nothing from where it is too little to be seen beside anything else (exp
/// takes ten times as long where it runs out of small numbers).
inline double faded(double exponent) noexcept {
  constexpr double kFaded = 50;  // e^-50 = 2e-22
  return exponent < kFaded ? std::exp(-exponent) : 0.0;
}

/// The terms of a model as accelerations [m/s^2], unpacked once so that an integrator pays only for what is
/// present: absent terms hold neutral values, flags skip what costs time. What each term means:
/// vocabulary.hpp.
struct PlantTerms {
  PlantTerms(const Model& model, bool disturbance_active);

  double beta, viscous, viscous_difference, drag;
  double alpha1, alpha2, gamma;
  double coulomb, stribeck_excess, stribeck_inverse_speed;
  double spot_peak, spot_centre, spot_inverse_width;
  double constant;
  struct Wave {
    double amplitude, wavenumber, phase;
  };
  std::array<Wave, kCoggingWaves.size()> cogging{};
  std::size_t cogging_waves = 0;  ///< how many of them there are
  double spring, spring_neutral;
  double disturbance_start, disturbance_duration, disturbance_peak;
  double dead_zone, saturation, gain_difference, current_limit;
  double lag_rate, delay, heating_loss, heating_rate;
  double bristle_stiffness, bristle_damping, bristle_inverse_speed, dahl_exponent;
  double gap, coupling_stiffness, coupling_damping;
  double load_share, load_friction_share, load_damping_share;

  bool has_level_shape, has_exponential, has_disturbance, has_current_limit, has_lag, has_delay, has_heating,
      has_bristle, has_dahl_bristle;
  bool two_masses, rigid_backlash;
  bool varies_in_time;  ///< net force at a standstill changes while a command is held
  bool breaks_at_rest;  ///< the force, or its slope, jumps where the velocity changes sign
  bool linear;  ///< one mass with viscous and Coulomb friction and a constant push: solved in closed form
  bool linear_two_masses;  ///< two masses with the same, and a coupling that is not rigid: a series in time
  bool linear_two_masses_by_steps;  ///< two masses that a series takes too, where what bends is a tangent
  double longest_step_s;            ///< resolves the fastest of the model's own motions
  double longest_series_step_s;     ///< the same, where a series is taken
  double longest_apart_step_s;      ///< and where two masses do not touch
  double series_rate, apart_rate;   ///< fastest rates of the model's own motions [1/s], so too

  /// Dead zone, saturation and gain asymmetry: what the amplifier makes of a command.
  double amplifier(double command_V) const noexcept {
    double u = command_V;
    if (dead_zone > 0) u = std::abs(u) <= dead_zone ? 0.0 : u - std::copysign(dead_zone, u);
    u = std::clamp(u, -saturation, saturation);
    return u * (1 + 0.5 * gain_difference * sign_of(u));
  }

  double damping(double v) const noexcept {
    const double speed = std::abs(v);
    double a = (drag * speed + viscous * (1 + 0.5 * viscous_difference * sign_of(v))) * v;
    if (has_exponential) a += (alpha1 * faded(alpha2 * speed) + gamma) * v;
    return a;
  }

  /// Drive less a share of the damping. The current limit holds drive less back-EMF, beta u - c v; back-EMF
  /// is then the motor's alone.
  double driven(double drive, double v, double damping_share) const noexcept {
    if (!has_current_limit) return drive - damping_share * damping(v);
    const double back_emf = viscous * v;
    return std::clamp(drive - back_emf, -current_limit, current_limit) -
           damping_share * (damping(v) - back_emf);
  }

  /// A straight line in the speed: at_zero + slope v.
  struct Tangent {
    double at_zero, slope;
  };

  /// The line that touches `damping` at v.
  Tangent damping_tangent(double v) const noexcept {
    const double speed = std::abs(v);
    Tangent line{-drag * speed * v, 2 * drag * speed + viscous * (1 + 0.5 * viscous_difference * sign_of(v))};
    if (has_exponential) {
      const double a = alpha1 * faded(alpha2 * speed);
      line.at_zero += a * alpha2 * speed * v;
      line.slope += a * (1 - alpha2 * speed) + gamma;
    }
    return line;
  }

  /// The line that touches `level`, as it goes with the amount of the speed, at v.
  Tangent level_tangent(double y, double v) const noexcept {
    Tangent line{level_of_place(y), 0};
    if (stribeck_excess != 0) {
      const double x = std::abs(v) * stribeck_inverse_speed;
      const double excess = stribeck_excess * faded(x * x);
      line.at_zero += excess * (1 + 2 * x * x);
      line.slope = -2 * x * excess * stribeck_inverse_speed;
    }
    return line;
  }

  /// By how much drive less back-EMF is beyond the current limit: the force has a corner where this changes
  /// sign.
  double over_current(double drive, double v) const noexcept {
    return std::abs(drive - viscous * v) - current_limit;
  }

  /// Damping of a second mass that carries a share of it.
  double load_damping(double v) const noexcept {
    return load_damping_share * (has_current_limit ? damping(v) - viscous * v : damping(v));
  }

  /// Level of friction: what opposes motion, and what it takes to start.
  double level(double y, double v) const noexcept {
    if (!has_level_shape) return coulomb;
    const double x = v * stribeck_inverse_speed;
    return level_of_place(y) + (stribeck_excess != 0 ? stribeck_excess * faded(x * x) : 0);
  }

  /// Of the level, what the speed does not change.
  double level_of_place(double y) const noexcept {
    if (spot_peak == 0) return coulomb;
    const double x = (y - spot_centre) * spot_inverse_width;
    return coulomb + spot_peak * faded(0.5 * x * x);
  }

  double pushes(double y, double time_s) const noexcept {
    double a = constant - spring * (y - spring_neutral);
    for (std::size_t i = 0; i < cogging_waves; ++i)
      a += cogging[i].amplitude * std::sin(cogging[i].wavenumber * y + cogging[i].phase);
    if (has_disturbance) {
      const double x = (time_s - disturbance_start) / disturbance_duration;
      if (x > 0 && x < 1) {
        const double sine = std::sin(std::numbers::pi * x);
        a += disturbance_peak * sine * sine;
      }
    }
    return a;
  }
};

}  // namespace cartwright
