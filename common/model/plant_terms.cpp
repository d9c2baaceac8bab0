#include "common/model/plant_terms.hpp"

#include <limits>

namespace cartwright {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Inner steps resolve the fastest rate w of a model to w h = 0.15: the Runge-Kutta method's local error is
/// then (w h)^5/120 < 1e-6 of the amplitude.
constexpr double kStepTimesRate = 0.15;
/// A Taylor series reaches as far as it has terms (plant_two_masses_linear.cpp); what bounds it is that one
/// step should not hold two events.
constexpr double kSeriesStepTimesRate = 0.6;
/// Keeps the cost of a very stiff model bounded. Rates up to 2.7/20 us are still stable.
constexpr double kLeastStep_s = 2e-5;

/// What joins motor and cart: a flexible coupling or, across a gap, teeth that give. Rate 0: rigid.
struct Joint {
  double rate_per_s = 0, damping_ratio = 0;
};

Joint joint_of(const Model& m) {
  if (m.has(Term::flexible_coupling))
    return {kTwoPi * m[Parameter::coupling_resonance], m[Parameter::coupling_damping_ratio]};
  if (m.has(Term::backlash))
    return {kTwoPi * m[Parameter::backlash_contact_resonance], m[Parameter::backlash_contact_damping_ratio]};
  return {};
}

/// Fastest rate [rad/s] at which a model moves by itself, but for what joins two masses.
double rate_apart(const PlantTerms& p) {
  double w = p.viscous * (1 + 0.5 * std::abs(p.viscous_difference)) + p.alpha1 + p.gamma;
  const auto oscillates = [&w](double stiffness) { w = std::max(w, std::sqrt(std::abs(stiffness))); };
  oscillates(p.spring);
  double steepest = 0;
  for (const PlantTerms::Wave& wave : p.cogging) steepest += wave.amplitude * wave.wavenumber;
  oscillates(steepest);
  if (p.stribeck_excess > 0) w = std::max(w, p.stribeck_excess * p.stribeck_inverse_speed);
  if (p.has_bristle) {
    // After a reversal a Dahl bristle is 2^n times as stiff, and damps as much more.
    const double more = p.has_dahl_bristle ? std::exp2(p.dahl_exponent) : 1.0;
    oscillates(more * p.bristle_stiffness / (p.two_masses ? p.load_share : 1.0));
    if (p.has_dahl_bristle) w = std::max(w, more * p.bristle_damping);
  }
  return w;
}

}  // namespace

PlantTerms::PlantTerms(const Model& m, bool disturbance_active) {
  const auto value = [&m](Term term, Parameter parameter, double absent) {
    return m.has(term) ? m[parameter] : absent;
  };
  beta = m[Parameter::voltage_gain];
  viscous = value(Term::viscous_friction, Parameter::viscous_coefficient, 0);
  viscous_difference = value(Term::asymmetric_viscous_friction, Parameter::asymmetric_viscous_difference, 0);
  drag = value(Term::quadratic_drag, Parameter::drag_coefficient, 0);
  alpha1 = value(Term::exponential_damping, Parameter::exponential_alpha1, 0);
  alpha2 = value(Term::exponential_damping, Parameter::exponential_alpha2, 0);
  gamma = value(Term::exponential_damping, Parameter::exponential_gamma, 0);
  coulomb = value(Term::coulomb_friction, Parameter::coulomb_level, 0);
  stribeck_excess = value(Term::stribeck_friction, Parameter::stribeck_excess, 0);
  stribeck_inverse_speed = 1 / value(Term::stribeck_friction, Parameter::stribeck_speed, 1);
  spot_peak = value(Term::position_dependent_friction, Parameter::spot_peak, 0);
  spot_centre = value(Term::position_dependent_friction, Parameter::spot_centre, 0);
  spot_inverse_width = 1 / value(Term::position_dependent_friction, Parameter::spot_width, 1);
  constant = value(Term::constant_force, Parameter::constant_acceleration, 0);
  for (const PeriodicTerm& wave : kCoggingWaves) {
    if (!m.has(Term::cogging) || m[wave.amplitude] == 0) continue;
    cogging[cogging_waves++] = {m[wave.amplitude], kTwoPi / m[wave.period], m[wave.phase]};
  }
  spring = value(Term::cable_spring, Parameter::spring_stiffness, 0);
  spring_neutral = value(Term::cable_spring, Parameter::spring_neutral, 0);
  disturbance_start = value(Term::external_disturbance, Parameter::disturbance_start, 0);
  disturbance_duration = value(Term::external_disturbance, Parameter::disturbance_duration, 1);
  disturbance_peak = value(Term::external_disturbance, Parameter::disturbance_peak, 0);
  dead_zone = value(Term::input_dead_zone, Parameter::dead_zone_half_width, 0);
  saturation = value(Term::voltage_saturation, Parameter::saturation_limit, kInfinity);
  gain_difference = value(Term::amplifier_gain_asymmetry, Parameter::amplifier_gain_difference, 0);
  current_limit = value(Term::current_limit, Parameter::current_limit, kInfinity);
  const double lag_s = value(Term::armature_lag, Parameter::armature_time_constant, 0);
  lag_rate = lag_s > 0 ? 1 / lag_s : 0;
  delay = value(Term::transport_delay, Parameter::transport_delay, 0);
  heating_loss = value(Term::motor_heating, Parameter::heating_gain_loss, 0);
  heating_rate = 1 / value(Term::motor_heating, Parameter::heating_time_constant, 1);
  bristle_stiffness = value(Term::presliding_friction, Parameter::presliding_stiffness, 0);
  bristle_damping = 2 * value(Term::presliding_friction, Parameter::presliding_damping_ratio, 0) *
                    std::sqrt(bristle_stiffness);
  bristle_inverse_speed = 1 / m[Parameter::presliding_damping_speed];
  dahl_exponent = value(Term::presliding_friction, Parameter::presliding_dahl_exponent, 0);
  gap = value(Term::backlash, Parameter::backlash_gap, 0);

  const bool flexible = m.has(Term::flexible_coupling);
  load_share = m[flexible ? Parameter::coupling_load_share : Parameter::backlash_load_share];
  load_friction_share =
      m[flexible ? Parameter::coupling_load_friction_share : Parameter::backlash_load_friction_share];
  load_damping_share =
      m[flexible ? Parameter::coupling_load_damping_share : Parameter::backlash_load_damping_share];
  // Relative motion x = x_motor - x_load of two free masses: x'' = -k x (1/s + 1/(1 - s)) = -w^2 x.
  const Joint joint = joint_of(m);
  const double reduced = load_share * (1 - load_share);
  coupling_stiffness = joint.rate_per_s * joint.rate_per_s * reduced;
  coupling_damping = 2 * joint.damping_ratio * joint.rate_per_s * reduced;

  has_level_shape = stribeck_excess != 0 || spot_peak != 0;
  has_exponential = m.has(Term::exponential_damping);
  has_disturbance = disturbance_active && disturbance_peak != 0;
  has_current_limit = m.has(Term::current_limit);
  has_lag = lag_s > 0;
  has_delay = delay > 0;
  has_heating = heating_loss != 0;
  has_bristle = bristle_stiffness > 0 && (coulomb > 0 || has_level_shape);
  two_masses = flexible || gap > 0;
  has_dahl_bristle = has_bristle && dahl_exponent > 0 && !two_masses;
  rigid_backlash = gap > 0 && joint.rate_per_s == 0;
  varies_in_time = has_lag || has_heating || has_disturbance;
  breaks_at_rest = coulomb > 0 || has_level_shape || viscous_difference != 0;
  const bool bends = varies_in_time || has_level_shape || cogging_waves > 0 || spring != 0 ||
                     has_exponential || has_current_limit || has_bristle || drag != 0;
  linear = !bends && !two_masses;
  linear_two_masses_by_steps = two_masses && !rigid_backlash && !has_bristle;
  linear_two_masses = linear_two_masses_by_steps && !bends && viscous_difference == 0;

  apart_rate = rate_apart(*this);
  series_rate = std::max(apart_rate, joint.rate_per_s * std::max(1.0, 2 * joint.damping_ratio));
  const double step_of_lag_s = has_lag ? std::max(lag_s, kLeastStep_s) : kInfinity;
  const auto longest_step = [&](double step_times_rate, double rate) {
    return rate > 0 ? std::min(step_of_lag_s, std::max(step_times_rate / rate, kLeastStep_s)) : step_of_lag_s;
  };
  longest_step_s = longest_step(kStepTimesRate, series_rate);
  longest_series_step_s = longest_step(kSeriesStepTimesRate, series_rate);
  longest_apart_step_s = longest_step(kSeriesStepTimesRate, apart_rate);
}

}  // namespace cartwright
