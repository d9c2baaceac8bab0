#include "tests/blind/concealed.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cartwright::blind {
namespace {

class Draw {
 public:
  Draw(std::uint64_t seed, Size size) : random_(seed), size_(size) {}

  double between(double low, double high) { return low + (high - low) * uniform_(random_); }
  double sign() { return uniform_(random_) < 0.5 ? -1 : 1; }
  /// The value of this size, within 15 %.
  double of(double third, double small, double medium, double large) {
    const double table[] = {third, small, medium, large};
    return table[static_cast<int>(size_)] * between(0.85, 1.15);
  }
  /// Sizes in the ratio 1/9 : 1/3 : 1 : 2.7.
  double around(double medium) { return of(medium / 9, medium / 3, medium, 2.7 * medium); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_;
  Size size_;
};

struct Hidden {
  std::string_view name;
  std::function<void(Draw&, CartPhysics&, std::map<std::string, double>&)> conceal;
};

void two_masses(Draw& d, CartPhysics& p) {
  p.load_share = d.between(0.3, 0.7);
  p.load_friction_share = d.between(0.3, 0.8);
  p.load_damping_share = d.between(0.1, 0.4);
}

using Truth = std::map<std::string, double>;

const std::vector<Hidden>& vocabulary() {
  static const std::vector<Hidden> list{
      {"coulomb_friction",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.coulomb_m_per_s2 = t["coulomb_friction.level_m_per_s2"] = d.around(0.4);
       }},
      {"exponential_damping",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.exponential_alpha1_per_s = d.around(2.5);
         p.exponential_alpha2_s_per_m = d.between(5, 12);
       }},
      {"stribeck_friction",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.stribeck_excess_m_per_s2 = t["stribeck_friction.excess_m_per_s2"] = d.around(0.4);
         p.stribeck_speed_m_per_s = t["stribeck_friction.speed_m_per_s"] = d.between(0.03, 0.07);
       }},
      {"constant_force",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.constant_m_per_s2 = t["constant_force.acceleration_m_per_s2"] = d.sign() * d.around(0.09);
       }},
      {"asymmetric_viscous_friction",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.viscous_difference = t["asymmetric_viscous_friction.relative_difference"] =
             d.sign() * d.around(0.15);
       }},
      {"position_dependent_friction",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.spot_peak_m_per_s2 = t["position_dependent_friction.peak_m_per_s2"] = d.around(0.75);
         p.spot_centre_m = t["position_dependent_friction.centre_m"] = d.between(-0.03, 0.07);
         p.spot_width_m = t["position_dependent_friction.width_m"] = d.between(0.015, 0.035);
       }},
      {"cogging",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.cogging_m_per_s2 = t["cogging.amplitude_m_per_s2"] = d.around(0.32);
         p.cogging_period_m = t["cogging.period_m"] = d.between(0.012, 0.03);
         p.cogging_phase_rad = d.between(0, 6.28);
       }},
      {"backlash",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.gap_m = t["backlash.gap_m"] = d.around(4.5e-4);
         two_masses(d, p);
       }},
      {"input_dead_zone",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.dead_zone_V = t["input_dead_zone.half_width_V"] = d.around(0.25);
       }},
      {"voltage_saturation",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.saturation_V = t["voltage_saturation.limit_V"] = d.of(9.5, 8.5, 6.2, 4.2);
       }},
      {"current_limit",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.current_limit_m_per_s2 = t["current_limit.limit_m_per_s2"] =
             p.gain_m_per_s2_V * d.of(8.8, 7.5, 5, 3.2);
       }},
      {"armature_lag", [](Draw& d, CartPhysics& p,
                          Truth& t) { p.lag_s = t["armature_lag.time_constant_s"] = d.around(0.0045); }},
      {"transport_delay", [](Draw& d, CartPhysics& p,
                             Truth& t) { p.delay_s = t["transport_delay.delay_s"] = d.around(0.0038); }},
      {"cable_spring",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.spring_per_s2 = t["cable_spring.stiffness_per_s2"] = d.around(2);
         p.spring_neutral_m = t["cable_spring.neutral_m"] = d.between(-0.03, 0.03);
       }},
      {"quadratic_drag",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.drag_per_m = t["quadratic_drag.coefficient_per_m"] = d.around(1.9);
       }},
      {"flexible_coupling",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.resonance_hz = t["flexible_coupling.resonance_hz"] = d.of(42, 30, 18, 11);
         p.damping_ratio = d.between(0.03, 0.06);
         two_masses(d, p);
       }},
      {"motor_heating",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.heating_loss = t["motor_heating.gain_loss"] = d.around(0.1);
         p.heating_time_s = t["motor_heating.time_constant_s"] = d.between(1.5, 5);
       }},
      {"encoder_eccentricity",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.eccentricity_m = t["encoder_eccentricity.amplitude_m"] = d.around(1.3e-4);
         p.eccentricity_period_m = t["encoder_eccentricity.period_m"] = d.between(0.03, 0.06);
         p.eccentricity_phase_rad = d.between(0, 6.28);
       }},
      {"encoder_missed_counts",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.lost_burst_counts = d.of(4, 8, 18, 45);
         p.lost_rate_per_s = d.between(1.5, 3.5);
         p.lost_speed_m_per_s = d.between(0.1, 0.2);
       }},
      {"presliding_friction",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.coulomb_m_per_s2 *= 1.6;
         p.bristle_per_s2 = t["presliding_friction.stiffness_per_s2"] = d.of(30000, 12000, 5000, 2000);
       }},
      {"external_disturbance",
       [](Draw& d, CartPhysics& p, Truth& t) {
         p.push_recording = static_cast<int>(d.between(0, 9.99));
         p.push_start_s = t["external_disturbance.start_s"] = d.between(1, 5);
         p.push_duration_s = t["external_disturbance.duration_s"] = d.between(0.1, 0.4);
         p.push_peak_m_per_s2 = t["external_disturbance.peak_m_per_s2"] = d.sign() * d.around(2.5);
       }},
      {"amplifier_gain_asymmetry", [](Draw& d, CartPhysics& p, Truth& t) {
         p.amplifier_difference = t["amplifier_gain_asymmetry.relative_difference"] =
             d.sign() * d.around(0.09);
       }}};
  return list;
}

void conceal(std::string_view name, Draw& d, CartPhysics& p, Truth& t) {
  const auto& list = vocabulary();
  std::find_if(list.begin(), list.end(), [&](const Hidden& one) {
    return one.name == name;
  })->conceal(d, p, t);
}

void lugre(Draw& d, CartPhysics& p, Truth& t) {
  conceal("presliding_friction", d, p, t);
  p.bristle_yields = true;
  const double ratio = t["presliding_friction.damping_ratio"] = d.between(0.05, 0.5);
  p.bristle_damping_per_s = 2 * ratio * std::sqrt(p.bristle_per_s2);
}

/// Shaped otherwise than its term, whose numbers are then not its own.
std::function<void(Draw&, CartPhysics&, Truth&)> reshaped(std::string_view name,
                                                          void (*reshape)(CartPhysics&)) {
  return [=](Draw& d, CartPhysics& p, Truth&) {
    Truth of_another_shape;
    conceal(name, d, p, of_another_shape);
    reshape(p);
  };
}

/// Named by what stands before the dot.
const std::vector<Hidden>& laws() {
  static const std::vector<Hidden> list{
      {"presliding_friction.dahl",
       [](Draw& d, CartPhysics& p, Truth& t) {
         conceal("presliding_friction", d, p, t);
         p.bristle_yields = true;
       }},
      {"presliding_friction.lugre", lugre},
      {"presliding_friction.fading",
       [](Draw& d, CartPhysics& p, Truth& t) {
         lugre(d, p, t);
         p.bristle_damping_speed_m_per_s = t["presliding_friction.damping_speed_m_per_s"] =
             d.between(0.005, 0.03);
       }},
      {"external_disturbance.sudden",
       reshaped("external_disturbance", [](CartPhysics& p) { p.push_power = 0; })},
      {"external_disturbance.half_sine",
       reshaped("external_disturbance", [](CartPhysics& p) { p.push_power = 1; })},
      {"cogging.square", reshaped("cogging", [](CartPhysics& p) { p.cogging_square = true; })}};
  return list;
}

const std::vector<Hidden>& outside() {
  static const std::vector<Hidden> list{
      {"x_vibration",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.vibration_m_per_s2 = d.around(0.5);
         p.vibration_hz = d.between(5, 14);
       }},
      {"x_warm_up",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.warm_up_m_per_s2 = d.around(0.4);
         p.warm_up_time_s = d.between(1, 3);
       }},
      {"x_cubic_spring", [](Draw& d, CartPhysics& p, Truth&) { p.cubic_spring_per_m2_s2 = d.around(300); }},
      {"x_drive_friction", [](Draw& d, CartPhysics& p, Truth&) { p.drive_friction = d.around(0.15); }},
      {"x_slew", [](Draw& d, CartPhysics& p, Truth&) { p.slew_V_per_s = d.of(4500, 1500, 500, 200); }},
      {"x_loose_contact",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.contact_rate_per_s = d.between(1, 2);
         p.contact_loss = d.of(0.1, 0.25, 0.6, 1);
       }},
      {"x_bumper", [](Draw& d, CartPhysics& p, Truth&) {
         p.bumper_at_m = d.between(0.05, 0.07);
         p.bumper_per_s2 = d.around(60);
       }}};
  return list;
}

const std::vector<Hidden>& foreign() {
  static const std::vector<Hidden> list{
      {"x_coarse_drive", [](Draw& d, CartPhysics& p, Truth&) { p.drive_step_V = d.of(0.2, 0.5, 1.2, 2.5); }},
      {"x_drive_play", [](Draw& d, CartPhysics& p, Truth&) { p.drive_play_V = d.around(0.25); }},
      {"x_compression", [](Draw& d, CartPhysics& p, Truth&) { p.compression = d.of(0.04, 0.1, 0.25, 0.5); }},
      {"x_gain_along_rail",
       [](Draw& d, CartPhysics& p, Truth&) { p.gain_slope_per_m = d.sign() * d.around(1); }},
      {"x_torque_ripple",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.ripple = d.around(0.08);
         p.ripple_period_m = d.between(0.012, 0.03);
       }},
      {"x_swinging_load",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.swing_ratio = d.around(0.08);
         p.swing_hz = d.between(1, 3);
       }},
      {"x_cable_chain",
       [](Draw& d, CartPhysics& p, Truth&) {
         p.chain_m_per_s2 = d.around(0.25);
         p.chain_reach_m = d.between(0.005, 0.02);
       }},
      {"x_scale_along_rail",
       [](Draw& d, CartPhysics& p, Truth&) { p.scale_slope_per_m = d.sign() * d.around(0.1); }},
      {"x_friction_drift", [](Draw& d, CartPhysics& p, Truth&) {
         if (p.coulomb_m_per_s2 == 0) p.coulomb_m_per_s2 = d.between(0.25, 0.6);
         p.drift = d.of(0.01, 0.02, 0.05, 0.09);
       }}};
  return list;
}

std::vector<std::string> names_of(const std::vector<Hidden>& list) {
  std::vector<std::string> names;
  for (const Hidden& one : list) names.emplace_back(one.name);
  return names;
}

}  // namespace

std::string_view name(Size size) {
  constexpr std::string_view names[] = {"third of small", "small", "medium", "large"};
  return names[static_cast<int>(size)];
}

const std::vector<std::string>& effects_of_the_vocabulary() {
  static const std::vector<std::string> names = names_of(vocabulary());
  return names;
}

const std::vector<std::string>& effects_by_other_laws() {
  static const std::vector<std::string> names = names_of(laws());
  return names;
}

const std::vector<std::string>& effects_outside() {
  static const std::vector<std::string> names = names_of(outside());
  return names;
}

const std::vector<std::string>& effects_foreign() {
  static const std::vector<std::string> names = names_of(foreign());
  return names;
}

Concealed draw(const std::vector<std::string>& effects, Size size, std::uint64_t seed,
               const Instruments& instruments) {
  Draw d(seed, size);
  Concealed c;
  CartPhysics& p = c.physics;
  p.count_m = instruments.count_m;
  p.gain_m_per_s2_V = d.between(1.5, 2.2);
  p.viscous_per_s = d.between(4, 7);
  const bool dry = d.between(0, 1) < 0.85;
  p.coulomb_m_per_s2 = dry ? d.between(0.25, 0.6) : 0;
  p.disturbance_m_per_s2 = d.between(0.01, 0.035);
  p.disturbance_time_s = d.between(0.003, 0.012);
  p.reading_noise_m = d.between(0.15, 0.4) * p.count_m;
  for (const std::string& effect : effects) {
    const bool needs_friction = effect.starts_with("presliding_friction") || effect == "backlash";
    if (needs_friction && p.coulomb_m_per_s2 == 0) p.coulomb_m_per_s2 = d.between(0.25, 0.6);
    if (effect == "coulomb_friction") c.nominal_has_coulomb = false;
    for (const auto* list : {&vocabulary(), &laws(), &outside(), &foreign()}) {
      for (const Hidden& one : *list) {
        if (one.name != effect) continue;
        one.conceal(d, p, c.truth);
        if (list == &vocabulary() || list == &laws())
          c.expected.push_back(effect.substr(0, effect.find('.')));
      }
    }
  }
  if (p.coulomb_m_per_s2 == 0) c.nominal_has_coulomb = false;
  const bool changed = !effects.empty() && effects.front() == "parameter_change";
  const double far = changed ? (d.sign() > 0 ? d.between(1.14, 1.3) : d.between(0.72, 0.87)) : 1;
  c.nominal_gain_m_per_s2_V = p.gain_m_per_s2_V * far * d.between(0.97, 1.03);
  c.nominal_viscous_per_s = p.viscous_per_s * d.between(0.95, 1.05);
  c.nominal_coulomb_m_per_s2 = p.coulomb_m_per_s2 * d.between(0.95, 1.05);
  return c;
}

}  // namespace cartwright::blind
