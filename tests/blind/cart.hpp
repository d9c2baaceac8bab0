#pragma once

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace cartwright::blind {

inline constexpr double kNone = std::numeric_limits<double>::infinity();

/// Everything a concealed cart may have. Written without the product's plant, integrator and events: a proof
/// on the product's own formulas would only show that they equal themselves. What is 0 (or infinite, for
/// limits) is absent.
struct CartPhysics {
  double gain_m_per_s2_V = 1.9, viscous_per_s = 5, coulomb_m_per_s2 = 0.4;

  double exponential_alpha1_per_s = 0, exponential_alpha2_s_per_m = 0;
  double stribeck_excess_m_per_s2 = 0, stribeck_speed_m_per_s = 1;
  double constant_m_per_s2 = 0;
  double viscous_difference = 0;
  double spot_peak_m_per_s2 = 0, spot_centre_m = 0, spot_width_m = 1;
  double cogging_m_per_s2 = 0, cogging_period_m = 1, cogging_phase_rad = 0;
  bool cogging_square = false;
  double dead_zone_V = 0, saturation_V = kNone, current_limit_m_per_s2 = kNone;
  double lag_s = 0;
  double delay_s = 0;
  double spring_per_s2 = 0, spring_neutral_m = 0;
  double drag_per_m = 0;
  double heating_loss = 0, heating_time_s = 1;
  double eccentricity_m = 0, eccentricity_period_m = 1, eccentricity_phase_rad = 0;
  double lost_burst_counts = 0, lost_rate_per_s = 0, lost_speed_m_per_s = 0;
  double bristle_per_s2 = 0, bristle_damping_per_s = 0, bristle_damping_speed_m_per_s = kNone;
  bool bristle_yields = false;  // it gives more and more before it slips
  int push_recording = -1;
  double push_start_s = 0, push_duration_s = 1, push_peak_m_per_s2 = 0;
  int push_power = 2;  // of the half sine that it is
  double amplifier_difference = 0;

  // Two masses: motor and cart, the encoder on the cart.
  double gap_m = 0;
  double resonance_hz = 0, damping_ratio = 0;
  double load_share = 0.5, load_friction_share = 0.5, load_damping_share = 0.5;

  // What the vocabulary has no name for.
  double vibration_m_per_s2 = 0, vibration_hz = 0;  // somebody's machine beside the rail
  double warm_up_m_per_s2 = 0, warm_up_time_s = 1;  // friction that falls while the grease warms
  double cubic_spring_per_m2_s2 = 0;                // stiffening tether
  double drive_friction = 0;                        // friction growing with the drive
  double slew_V_per_s = kNone;                      // amplifier slew
  double contact_rate_per_s = 0, contact_loss = 0;  // a loose plug: for 20 ms the gain is less
  double bumper_at_m = kNone, bumper_per_s2 = 0;    // a soft stop on one side
  double drive_step_V = 0;                          // a coarse converter before the amplifier
  double drive_play_V = 0;                          // an amplifier with hysteresis: half its width
  double compression = 0;                           // part of the gain lost at 12 V, as its square
  double gain_slope_per_m = 0;                      // a gain that changes along the rail
  double ripple = 0, ripple_period_m = 1;           // a gain that changes with the angle of the motor
  double swing_ratio = 0, swing_hz = 1;             // mass of a load that hangs from the cart and swings
  double chain_m_per_s2 = 0, chain_reach_m = 1;     // a cable chain: springs back, then drags along
  double scale_slope_per_m = 0;                     // an encoder whose scale changes along the rail
  double drift = 0;                                 // part of the friction lost from recording to recording

  // The world: a disturbance acceleration, first-order coloured, and the reading.
  double disturbance_m_per_s2 = 0.02, disturbance_time_s = 0.005;
  double count_m = 2.275e-5, reading_noise_m = 5e-6;
};

/// One run of a cart from rest: semi-implicit Euler in steps of 4 us (5 us with two masses), friction that
/// holds by comparing forces.
class Cart {
 public:
  Cart(const CartPhysics& physics, int recording, std::uint64_t seed);

  /// What the encoder says now.
  double read();
  /// Holds a command from `t_s` for `span_s`.
  void hold(double u_V, double t_s, double span_s);

 private:
  double amplifier(double u_V, double span_s);
  double level(double t_s, double y_m, double v_m_per_s, double drive) const;
  double push(double t_s) const;
  double damping(double v_m_per_s) const;
  double gain_at(double t_s, double u_V) const;
  double carried(double h_s);
  void step_one_mass(double t_s, double drive, double h_s);
  void step_two_masses(double t_s, double drive, double h_s);
  void lose_counts(double h_s);

  const CartPhysics p_;
  const int recording_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  double y_m_ = 0, v_m_per_s_ = 0, motor_y_m_ = 0, motor_v_m_per_s_ = 0;
  double bristle_m_ = 0, lagged_V_ = 0, slewed_V_ = 0, disturbance_ = 0, lost_m_ = 0;
  double played_V_ = 0, chain_m_ = 0, swing_m_ = 0, swing_m_per_s_ = 0;
  double loose_until_s_ = -1;
  // Commands still under way through the delay: when each one arrives.
  struct Arrival {
    double t_s, u_V;
  };
  std::vector<Arrival> under_way_;
  std::size_t arrived_ = 0;
  double arrived_V_ = 0;
};

}  // namespace cartwright::blind
