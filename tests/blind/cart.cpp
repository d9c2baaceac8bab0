#include "tests/blind/cart.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright::blind {
namespace {

constexpr double kStep_s = 4e-6;  // explicit: gain and damping come out c h/2 = 1e-5 too large
constexpr double kStepTwoMasses_s = 5e-6;
/// Teeth that meet across a gap: a stiff spring with a damper, per unit of moving mass.
constexpr double kToothStiffness_per_s2 = 4e6;
constexpr double kToothDamping_per_s = 600;
constexpr double kLooseContact_s = 0.02;

double sign(double x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

/// Speed after a step under dry friction: what the push alone would make of it, less what friction can take.
double with_dry_friction(double v, double push, double level, double h) {
  const double free = v + h * push;
  return std::abs(free) <= h * level ? 0 : free - h * level * sign(free);
}

}  // namespace

Cart::Cart(const CartPhysics& physics, int recording, std::uint64_t seed)
    : p_(physics),
      recording_(recording),
      random_(seed),
      disturbance_(physics.disturbance_m_per_s2 * normal_(random_)) {}

double Cart::read() {
  const double eccentric =
      p_.eccentricity_m * std::sin(2 * M_PI * y_m_ / p_.eccentricity_period_m + p_.eccentricity_phase_rad);
  const double scale = 1 + p_.scale_slope_per_m * y_m_;
  const double seen = scale * y_m_ + eccentric + lost_m_ + p_.reading_noise_m * normal_(random_);
  return p_.count_m * std::round(seen / p_.count_m);
}

void Cart::hold(double u_V, double t_s, double span_s) {
  under_way_.push_back({t_s + p_.delay_s, u_V});
  const bool two_masses = p_.gap_m > 0 || p_.resonance_hz > 0;
  const int steps = static_cast<int>(std::ceil(span_s / (two_masses ? kStepTwoMasses_s : kStep_s)));
  const double h = span_s / steps;
  const double fade = std::exp(-span_s / p_.disturbance_time_s);
  disturbance_ =
      fade * disturbance_ + p_.disturbance_m_per_s2 * std::sqrt(1 - fade * fade) * normal_(random_);
  if (p_.contact_rate_per_s > 0 && uniform_(random_) < p_.contact_rate_per_s * span_s)
    loose_until_s_ = t_s + kLooseContact_s;
  for (int i = 0; i < steps; ++i) {
    const double t = t_s + i * h;
    while (arrived_ < under_way_.size() && under_way_[arrived_].t_s <= t + 0.5 * h)
      arrived_V_ = under_way_[arrived_++].u_V;
    const double voltage = amplifier(arrived_V_, h);
    const double drive = gain_at(t, arrived_V_) * voltage + carried(h);
    if (two_masses) {
      step_two_masses(t, drive, h);
    } else {
      step_one_mass(t, drive, h);
    }
    if (p_.lost_rate_per_s > 0) lose_counts(h);
  }
}

double Cart::gain_at(double t_s, double u_V) const {
  double gain = p_.gain_m_per_s2_V * (1 + 0.5 * p_.amplifier_difference * sign(u_V));
  gain *= 1 - p_.heating_loss * (1 - std::exp(-t_s / p_.heating_time_s));
  gain *= 1 - p_.compression * u_V * u_V / 144;
  gain *= 1 + p_.gain_slope_per_m * y_m_ + p_.ripple * std::sin(2 * M_PI * y_m_ / p_.ripple_period_m);
  if (t_s < loose_until_s_) gain *= 1 - p_.contact_loss;
  return gain;
}

/// The push of what the cart takes along: a load that swings from it, a chain that its cable lies in.
double Cart::carried(double h_s) {
  double push = 0;
  if (p_.swing_ratio > 0) {
    const double w = 2 * M_PI * p_.swing_hz;
    const double away = swing_m_ - y_m_, rate = swing_m_per_s_ - v_m_per_s_;
    const double on_load = -w * w * away - 2 * 0.02 * w * rate;
    swing_m_per_s_ += h_s * on_load;
    swing_m_ += h_s * swing_m_per_s_;
    push -= p_.swing_ratio * on_load;
  }
  if (p_.chain_m_per_s2 > 0) {
    chain_m_ = std::clamp(chain_m_ + h_s * v_m_per_s_, -p_.chain_reach_m, p_.chain_reach_m);
    push -= p_.chain_m_per_s2 * chain_m_ / p_.chain_reach_m;
  }
  return push;
}

double Cart::amplifier(double u_V, double h_s) {
  if (p_.drive_step_V > 0) u_V = p_.drive_step_V * std::round(u_V / p_.drive_step_V);
  if (p_.drive_play_V > 0)
    u_V = played_V_ = std::clamp(played_V_, u_V - p_.drive_play_V, u_V + p_.drive_play_V);
  double u = std::abs(u_V) < p_.dead_zone_V ? 0 : u_V - p_.dead_zone_V * sign(u_V);
  u = std::clamp(u, -p_.saturation_V, p_.saturation_V);
  if (std::isfinite(p_.slew_V_per_s)) {
    slewed_V_ += std::clamp(u - slewed_V_, -p_.slew_V_per_s * h_s, p_.slew_V_per_s * h_s);
    u = slewed_V_;
  }
  if (p_.lag_s <= 0) return u;
  const double before = lagged_V_;
  lagged_V_ += (1 - std::exp(-h_s / p_.lag_s)) * (u - lagged_V_);
  return 0.5 * (before + lagged_V_);
}

double Cart::level(double t_s, double y_m, double v_m_per_s, double drive) const {
  const double slow = v_m_per_s / p_.stribeck_speed_m_per_s;
  const double away = (y_m - p_.spot_centre_m) / p_.spot_width_m;
  return p_.coulomb_m_per_s2 * (1 - p_.drift * recording_) +
         p_.stribeck_excess_m_per_s2 * std::exp(-slow * slow) +
         p_.spot_peak_m_per_s2 * std::exp(-0.5 * away * away) +
         p_.warm_up_m_per_s2 * std::exp(-t_s / p_.warm_up_time_s) + p_.drive_friction * std::abs(drive);
}

double Cart::push(double t_s) const {
  const double from_neutral = y_m_ - p_.spring_neutral_m;
  const double tooth = std::sin(2 * M_PI * y_m_ / p_.cogging_period_m + p_.cogging_phase_rad);
  double push = p_.constant_m_per_s2 + disturbance_ - p_.spring_per_s2 * from_neutral -
                p_.cubic_spring_per_m2_s2 * y_m_ * y_m_ * y_m_ +
                p_.cogging_m_per_s2 * (p_.cogging_square ? sign(tooth) : tooth) +
                p_.vibration_m_per_s2 * std::sin(2 * M_PI * p_.vibration_hz * t_s + recording_);
  if (y_m_ > p_.bumper_at_m) push -= p_.bumper_per_s2 * (y_m_ - p_.bumper_at_m);
  const double into = (t_s - p_.push_start_s) / p_.push_duration_s;
  if (recording_ == p_.push_recording && into > 0 && into < 1) {
    push += p_.push_peak_m_per_s2 * std::pow(std::sin(M_PI * into), p_.push_power);
  }
  return push;
}

double Cart::damping(double v) const {
  return p_.viscous_per_s * (1 + 0.5 * p_.viscous_difference * sign(v)) * v +
         p_.drag_per_m * v * std::abs(v) +
         p_.exponential_alpha1_per_s * std::exp(-p_.exponential_alpha2_s_per_m * std::abs(v)) * v;
}

void Cart::step_one_mass(double t_s, double drive, double h) {
  // A current limit acts on the drive less the back-EMF, here the whole viscous coefficient.
  double force = drive - damping(v_m_per_s_);
  if (std::isfinite(p_.current_limit_m_per_s2))
    force = std::clamp(force, -p_.current_limit_m_per_s2, p_.current_limit_m_per_s2);
  force += push(t_s);
  const double most = level(t_s, y_m_, v_m_per_s_, drive);
  const double before = v_m_per_s_;
  if (p_.bristle_per_s2 > 0) {
    // A bristle that slips when it is stretched as far as friction goes: elastic up to there, or less and
    // less.
    const double reach = most / p_.bristle_per_s2;
    const double yields = p_.bristle_yields ? std::abs(v_m_per_s_) / reach * bristle_m_ : 0;
    const double slow = v_m_per_s_ / p_.bristle_damping_speed_m_per_s;
    force -= p_.bristle_per_s2 * bristle_m_ +
             p_.bristle_damping_per_s * std::exp(-slow * slow) * (v_m_per_s_ - yields);
    v_m_per_s_ += h * force;
    bristle_m_ = std::clamp(bristle_m_ + h * (v_m_per_s_ - yields), -reach, reach);
  } else {
    v_m_per_s_ = with_dry_friction(v_m_per_s_, force, most, h);
  }
  y_m_ += 0.5 * h * (before + v_m_per_s_);
}

void Cart::step_two_masses(double t_s, double drive, double h) {
  const double s = p_.load_share, f = p_.load_friction_share, d = p_.load_damping_share;
  const double apart = motor_y_m_ - y_m_, rate = motor_v_m_per_s_ - v_m_per_s_;
  const double reduced = s * (1 - s);
  double between = 0;
  if (p_.gap_m > 0) {
    const double pressed = apart - std::clamp(apart, -0.5 * p_.gap_m, 0.5 * p_.gap_m);
    if (pressed != 0) {
      between = reduced * (kToothStiffness_per_s2 * pressed + kToothDamping_per_s * rate);
      between = pressed > 0 ? std::max(between, 0.0) : std::min(between, 0.0);
    }
  } else {
    const double w = 2 * M_PI * p_.resonance_hz;
    between = reduced * (w * w * apart + 2 * p_.damping_ratio * w * rate);
  }
  const double friction = level(t_s, y_m_, v_m_per_s_, drive);
  const double cart = (between + push(t_s) - d * damping(v_m_per_s_)) / s;
  const double motor = (drive - (1 - d) * damping(motor_v_m_per_s_) - between) / (1 - s);
  v_m_per_s_ = with_dry_friction(v_m_per_s_, cart, f * friction / s, h);
  motor_v_m_per_s_ = with_dry_friction(motor_v_m_per_s_, motor, (1 - f) * friction / (1 - s), h);
  y_m_ += h * v_m_per_s_;
  motor_y_m_ += h * motor_v_m_per_s_;
}

void Cart::lose_counts(double h_s) {
  if (std::abs(v_m_per_s_) < p_.lost_speed_m_per_s || uniform_(random_) >= p_.lost_rate_per_s * h_s) return;
  const double burst = std::max(1.0, std::round(p_.lost_burst_counts * (0.75 + 0.5 * uniform_(random_))));
  lost_m_ -= sign(v_m_per_s_) * burst * p_.count_m;
}

}  // namespace cartwright::blind
