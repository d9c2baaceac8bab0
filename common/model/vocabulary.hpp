#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace cartwright {

/// The physics a cart model can hold besides its voltage gain. Every term is an acceleration (force divided
/// by the moving mass) in  d2y/dt2 = beta u - sum(opposing terms) + sum(pushes).
enum class Term {
  viscous_friction,
  coulomb_friction,
  exponential_damping,
  stribeck_friction,
  constant_force,
  asymmetric_viscous_friction,
  position_dependent_friction,
  cogging,
  backlash,
  input_dead_zone,
  voltage_saturation,
  current_limit,
  armature_lag,
  transport_delay,
  cable_spring,
  quadratic_drag,
  flexible_coupling,
  motor_heating,
  encoder_eccentricity,
  encoder_missed_counts,
  presliding_friction,
  external_disturbance,
  amplifier_gain_asymmetry,
};
inline constexpr std::size_t kTermCount = 23;

/// Every number of a model, in the order of the terms that own them. The name in a file is `term.parameter`.
enum class Parameter {
  voltage_gain,
  viscous_coefficient,
  coulomb_level,
  exponential_alpha1,
  exponential_alpha2,
  exponential_gamma,
  stribeck_excess,
  stribeck_speed,
  constant_acceleration,
  asymmetric_viscous_difference,
  spot_peak,
  spot_centre,
  spot_width,
  cogging_amplitude,
  cogging_period,
  cogging_phase,
  cogging_second_amplitude,
  cogging_second_period,
  cogging_second_phase,
  cogging_third_amplitude,
  cogging_third_period,
  cogging_third_phase,
  backlash_gap,
  backlash_load_share,
  backlash_load_friction_share,
  backlash_load_damping_share,
  backlash_contact_resonance,
  backlash_contact_damping_ratio,
  dead_zone_half_width,
  saturation_limit,
  current_limit,
  armature_time_constant,
  transport_delay,
  spring_stiffness,
  spring_neutral,
  drag_coefficient,
  coupling_resonance,
  coupling_damping_ratio,
  coupling_load_share,
  coupling_load_friction_share,
  coupling_load_damping_share,
  heating_gain_loss,
  heating_time_constant,
  eccentricity_amplitude,
  eccentricity_period,
  eccentricity_phase,
  missed_burst,
  missed_rate,
  missed_speed,
  presliding_stiffness,
  presliding_dahl_exponent,
  presliding_damping_ratio,
  presliding_damping_speed,
  disturbance_start,
  disturbance_duration,
  disturbance_peak,
  amplifier_gain_difference,
};
inline constexpr std::size_t kParameterCount = 57;

/// The numbers of something that repeats along the way.
struct PeriodicTerm {
  Parameter amplitude, period, phase;
  constexpr bool has(Parameter one) const { return one == amplitude || one == period || one == phase; }
};
/// The waves of the cogging: poles, slots and teeth each bring their own, and their multiples. One is part of
/// a model where its amplitude is not zero.
inline constexpr std::array<PeriodicTerm, 3> kCoggingWaves{{
    {Parameter::cogging_amplitude, Parameter::cogging_period, Parameter::cogging_phase},
    {Parameter::cogging_second_amplitude, Parameter::cogging_second_period, Parameter::cogging_second_phase},
    {Parameter::cogging_third_amplitude, Parameter::cogging_third_period, Parameter::cogging_third_phase},
}};

struct ParameterInfo {
  Parameter id;
  std::optional<Term> term;             ///< none for the voltage gain, which every model has
  std::string_view key;                 ///< name in the model file, unit last
  double lower;                         ///< least value a model may hold
  double upper;                         ///< greatest value a model may hold
  std::optional<double> default_value;  ///< set where the file may leave the parameter out
  std::string_view meaning;
};

struct TermInfo {
  Term id;
  std::string_view name;     ///< the table's name in the model file
  std::string_view meaning;  ///< the physics, in words and as an equation
};

std::span<const TermInfo, kTermCount> terms();
std::span<const ParameterInfo, kParameterCount> parameters();

const TermInfo& info(Term term);
const ParameterInfo& info(Parameter parameter);

/// The parameters of one term, in file order.
std::span<const ParameterInfo> parameters_of(Term term);

std::optional<Term> find_term(std::string_view name);

/// Looks up `voltage_gain_m_per_s2_V` or `term.key`.
std::optional<Parameter> find_parameter(std::string_view dotted_name);

}  // namespace cartwright
