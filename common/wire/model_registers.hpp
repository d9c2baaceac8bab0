#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "common/model/vocabulary.hpp"
#include "common/wire/ids.hpp"

namespace cartwright::wire {

/// The registers that hold the model of the compensation: every parameter of a term that the feed-forward can
/// invert. A term is part of the model when one of its registers differs from the initial value.
inline constexpr std::array<std::pair<Parameter, Id>, 27> kModelRegisters{{
    {Parameter::voltage_gain, Id::model_voltage_gain_m_per_s2_V},
    {Parameter::viscous_coefficient, Id::model_viscous_friction_coefficient_per_s},
    {Parameter::coulomb_level, Id::model_coulomb_friction_level_m_per_s2},
    {Parameter::exponential_alpha1, Id::model_exponential_damping_alpha1_per_s},
    {Parameter::exponential_alpha2, Id::model_exponential_damping_alpha2_s_per_m},
    {Parameter::exponential_gamma, Id::model_exponential_damping_gamma_per_s},
    {Parameter::stribeck_excess, Id::model_stribeck_friction_excess_m_per_s2},
    {Parameter::stribeck_speed, Id::model_stribeck_friction_speed_m_per_s},
    {Parameter::constant_acceleration, Id::model_constant_force_acceleration_m_per_s2},
    {Parameter::asymmetric_viscous_difference, Id::model_asymmetric_viscous_friction_relative_difference},
    {Parameter::spot_peak, Id::model_position_dependent_friction_peak_m_per_s2},
    {Parameter::spot_centre, Id::model_position_dependent_friction_centre_m},
    {Parameter::spot_width, Id::model_position_dependent_friction_width_m},
    {Parameter::cogging_amplitude, Id::model_cogging_amplitude_m_per_s2},
    {Parameter::cogging_period, Id::model_cogging_period_m},
    {Parameter::cogging_phase, Id::model_cogging_phase_rad},
    {Parameter::dead_zone_half_width, Id::model_input_dead_zone_half_width_V},
    {Parameter::spring_stiffness, Id::model_cable_spring_stiffness_per_s2},
    {Parameter::spring_neutral, Id::model_cable_spring_neutral_m},
    {Parameter::drag_coefficient, Id::model_quadratic_drag_coefficient_per_m},
    {Parameter::amplifier_gain_difference, Id::model_amplifier_gain_asymmetry_relative_difference},
    {Parameter::cogging_second_amplitude, Id::model_cogging_second_amplitude_m_per_s2},
    {Parameter::cogging_second_period, Id::model_cogging_second_period_m},
    {Parameter::cogging_second_phase, Id::model_cogging_second_phase_rad},
    {Parameter::cogging_third_amplitude, Id::model_cogging_third_amplitude_m_per_s2},
    {Parameter::cogging_third_period, Id::model_cogging_third_period_m},
    {Parameter::cogging_third_phase, Id::model_cogging_third_phase_rad},
}};

/// The words for compensation_mode 0, 1 and 2.
inline constexpr std::array<std::string_view, 3> kCompensationNames{"off", "feedforward", "adaptive"};

}  // namespace cartwright::wire
