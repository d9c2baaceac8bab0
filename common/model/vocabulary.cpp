#include "common/model/vocabulary.hpp"

#include <limits>

namespace cartwright {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kTiny = 1e-12;  // "greater than zero" for quantities that divide

using P = Parameter;
using T = Term;

constexpr std::array<TermInfo, kTermCount> kTerms{{
    {T::viscous_friction, "viscous_friction", "c v, back-EMF included"},
    {T::coulomb_friction, "coulomb_friction", "level sgn v; holds the cart still up to this level"},
    {T::exponential_damping, "exponential_damping", "(alpha1 exp(-alpha2 |v|) + gamma) v"},
    {T::stribeck_friction, "stribeck_friction",
     "extra friction at low speed, excess exp(-(v/speed)^2) sgn v"},
    {T::constant_force, "constant_force",
     "added push, positive towards +y: track tilt, amplifier offset and Coulomb asymmetry are one and the "
     "same"},
    {T::asymmetric_viscous_friction, "asymmetric_viscous_friction",
     "viscous coefficient differs between directions: c (1 + d/2 sgn v)"},
    {T::position_dependent_friction, "position_dependent_friction",
     "extra Coulomb level, a Gaussian spot on the rail: peak exp(-((y - centre)/width)^2 / 2)"},
    {T::cogging, "cogging",
     "periodic push in position: amplitude sin(2 pi y/period + phase), in up to three waves"},
    {T::backlash, "backlash",
     "total lost motion between motor and cart, encoder on the cart; impacts are inelastic unless the "
     "teeth give"},
    {T::input_dead_zone, "input_dead_zone", "command inside it gives nothing; outside, shifted by it"},
    {T::voltage_saturation, "voltage_saturation", "the amplifier really delivers no more than this"},
    {T::current_limit, "current_limit", "drive less back-EMF, beta u - c v, is held within +-limit"},
    {T::armature_lag, "armature_lag", "first-order lag from command to force"},
    {T::transport_delay, "transport_delay", "pure delay from command to force"},
    {T::cable_spring, "cable_spring", "tether pull -k (y - neutral)"},
    {T::quadratic_drag, "quadratic_drag", "coefficient v |v|"},
    {T::flexible_coupling, "flexible_coupling", "two masses on a damped spring, encoder on the load"},
    {T::motor_heating, "motor_heating",
     "beta (1 - loss (1 - exp(-t/T))), t from the start of each recording"},
    {T::encoder_eccentricity, "encoder_eccentricity", "measured y = y + a sin(2 pi y/period + phase)"},
    {T::encoder_missed_counts, "encoder_missed_counts",
     "bursts of counts lost, at a rate, while faster than a speed: the reading jumps back and stays off"},
    {T::presliding_friction, "presliding_friction", "before breakaway friction is an elastic bristle"},
    {T::external_disturbance, "external_disturbance",
     "a push in one recording only that swells and fades: peak sin^2(pi (t - start)/duration)"},
    {T::amplifier_gain_asymmetry, "amplifier_gain_asymmetry",
     "gain differs between signs of u: beta (1 + d/2 sgn u)"},
}};

constexpr std::array<ParameterInfo, kParameterCount> kParameters{{
    {P::voltage_gain, {}, "voltage_gain_m_per_s2_V", -kInf, kInf, {}, "beta, acceleration per volt"},
    {P::viscous_coefficient, T::viscous_friction, "coefficient_per_s", 0, kInf, {}, "c"},
    {P::coulomb_level, T::coulomb_friction, "level_m_per_s2", 0, kInf, {}, "friction level"},
    {P::exponential_alpha1, T::exponential_damping, "alpha1_per_s", 0, kInf, {}, "extra damping at rest"},
    {P::exponential_alpha2, T::exponential_damping, "alpha2_s_per_m", 0, kInf, {}, "decay over speed"},
    {P::exponential_gamma, T::exponential_damping, "gamma_per_s", 0, kInf, {}, "damping at high speed"},
    {P::stribeck_excess, T::stribeck_friction, "excess_m_per_s2", 0, kInf, {}, "extra level at rest"},
    {P::stribeck_speed, T::stribeck_friction, "speed_m_per_s", kTiny, kInf, {}, "speed at which 1/e is left"},
    {P::constant_acceleration, T::constant_force, "acceleration_m_per_s2", -kInf, kInf, {}, "push"},
    {P::asymmetric_viscous_difference, T::asymmetric_viscous_friction, "relative_difference", -2, 2, {}, "d"},
    {P::spot_peak, T::position_dependent_friction, "peak_m_per_s2", 0, kInf, {}, "extra level at the centre"},
    {P::spot_centre, T::position_dependent_friction, "centre_m", -kInf, kInf, {}, "where on the rail"},
    {P::spot_width,
     T::position_dependent_friction,
     "width_m",
     kTiny,
     kInf,
     {},
     "standard deviation of the spot"},
    {P::cogging_amplitude, T::cogging, "amplitude_m_per_s2", 0, kInf, {}, "amplitude"},
    {P::cogging_period, T::cogging, "period_m", kTiny, kInf, {}, "period"},
    {P::cogging_phase, T::cogging, "phase_rad", -kInf, kInf, {}, "phase at y = 0"},
    {P::cogging_second_amplitude, T::cogging, "second_amplitude_m_per_s2", 0, kInf, 0.0,
     "amplitude of a second wave"},
    {P::cogging_second_period, T::cogging, "second_period_m", kTiny, kInf, 1.0, "its period"},
    {P::cogging_second_phase, T::cogging, "second_phase_rad", -kInf, kInf, 0.0, "its phase at y = 0"},
    {P::cogging_third_amplitude, T::cogging, "third_amplitude_m_per_s2", 0, kInf, 0.0,
     "amplitude of a third wave"},
    {P::cogging_third_period, T::cogging, "third_period_m", kTiny, kInf, 1.0, "its period"},
    {P::cogging_third_phase, T::cogging, "third_phase_rad", -kInf, kInf, 0.0, "its phase at y = 0"},
    {P::backlash_gap, T::backlash, "gap_m", 0, kInf, {}, "total lost motion"},
    {P::backlash_load_share, T::backlash, "load_share", 0.01, 0.99, 0.5,
     "share of the mass on the cart side"},
    {P::backlash_load_friction_share, T::backlash, "load_friction_share", 0, 1, 0.5,
     "share of the friction levels on the cart side"},
    {P::backlash_load_damping_share, T::backlash, "load_damping_share", 0, 1, 0.5,
     "share of the damping on the cart side"},
    {P::backlash_contact_resonance, T::backlash, "contact_resonance_hz", 0, 1000, 0.0,
     "resonance of the masses on teeth that meet and give; 0: rigid teeth"},
    {P::backlash_contact_damping_ratio, T::backlash, "contact_damping_ratio", 0, 10, 0.2,
     "of that resonance"},
    {P::dead_zone_half_width, T::input_dead_zone, "half_width_V", 0, kInf, {}, "half width"},
    {P::saturation_limit, T::voltage_saturation, "limit_V", 0, kInf, {}, "greatest voltage delivered"},
    {P::current_limit, T::current_limit, "limit_m_per_s2", 0, kInf, {}, "greatest drive acceleration"},
    {P::armature_time_constant, T::armature_lag, "time_constant_s", 0, 1, {}, "time constant"},
    {P::transport_delay, T::transport_delay, "delay_s", 0, 0.1, {}, "delay"},
    {P::spring_stiffness, T::cable_spring, "stiffness_per_s2", -kInf, kInf, {}, "k"},
    {P::spring_neutral, T::cable_spring, "neutral_m", -kInf, kInf, {}, "position without pull"},
    {P::drag_coefficient, T::quadratic_drag, "coefficient_per_m", 0, kInf, {}, "coefficient"},
    {P::coupling_resonance,
     T::flexible_coupling,
     "resonance_hz",
     0.1,
     1000,
     {},
     "resonance with both masses free"},
    {P::coupling_damping_ratio, T::flexible_coupling, "damping_ratio", 0, 10, {}, "of that resonance"},
    {P::coupling_load_share,
     T::flexible_coupling,
     "load_share",
     0.01,
     0.99,
     {},
     "share of the mass on the encoder side"},
    {P::coupling_load_friction_share, T::flexible_coupling, "load_friction_share", 0, 1, 0.5,
     "share of the friction levels on the encoder side"},
    {P::coupling_load_damping_share, T::flexible_coupling, "load_damping_share", 0, 1, 0.5,
     "share of the damping on the encoder side"},
    {P::heating_gain_loss, T::motor_heating, "gain_loss", -1, 1, {}, "loss once warm"},
    {P::heating_time_constant, T::motor_heating, "time_constant_s", kTiny, kInf, {}, "T"},
    {P::eccentricity_amplitude, T::encoder_eccentricity, "amplitude_m", 0, kInf, {}, "a"},
    {P::eccentricity_period, T::encoder_eccentricity, "period_m", kTiny, kInf, {}, "period"},
    {P::eccentricity_phase, T::encoder_eccentricity, "phase_rad", -kInf, kInf, {}, "phase at y = 0"},
    {P::missed_burst, T::encoder_missed_counts, "burst_counts", 0, kInf, {}, "counts lost in a burst"},
    {P::missed_rate, T::encoder_missed_counts, "rate_per_s", 0, kInf, {}, "bursts per second while fast"},
    {P::missed_speed, T::encoder_missed_counts, "speed_m_per_s", 0, kInf, {}, "speed above which it happens"},
    {P::presliding_stiffness,
     T::presliding_friction,
     "stiffness_per_s2",
     kTiny,
     kInf,
     {},
     "bristle stiffness"},
    {P::presliding_dahl_exponent, T::presliding_friction, "dahl_exponent", 0, 1, 0.0,
     "0: elastic up to breakaway; 1: gives more and more on the way there"},
    {P::presliding_damping_ratio, T::presliding_friction, "damping_ratio", 0, 10, 0.0,
     "of the cart swinging on a bristle with dahl_exponent > 0"},
    {P::presliding_damping_speed, T::presliding_friction, "damping_speed_m_per_s", kTiny, kInf, kInf,
     "speed at which 1/e of that damping is left"},
    {P::disturbance_start, T::external_disturbance, "start_s", -kInf, kInf, {}, "start, on the file's time"},
    {P::disturbance_duration, T::external_disturbance, "duration_s", kTiny, kInf, {}, "duration"},
    {P::disturbance_peak, T::external_disturbance, "peak_m_per_s2", -kInf, kInf, {}, "greatest push"},
    {P::amplifier_gain_difference, T::amplifier_gain_asymmetry, "relative_difference", -2, 2, {}, "d"},
}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kTermCount; ++i) {
    if (static_cast<std::size_t>(kTerms[i].id) != i) return false;
  }
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (static_cast<std::size_t>(kParameters[i].id) != i) return false;
  }
  return true;
}
static_assert(in_order(), "the tables stand in the order of the enumerations");

}  // namespace

std::span<const TermInfo, kTermCount> terms() {
  return kTerms;
}
std::span<const ParameterInfo, kParameterCount> parameters() {
  return kParameters;
}

const TermInfo& info(Term term) {
  return kTerms[static_cast<std::size_t>(term)];
}
const ParameterInfo& info(Parameter parameter) {
  return kParameters[static_cast<std::size_t>(parameter)];
}

std::span<const ParameterInfo> parameters_of(Term term) {
  std::size_t first = 0;
  while (first < kParameterCount && kParameters[first].term != term) ++first;
  std::size_t last = first;
  while (last < kParameterCount && kParameters[last].term == term) ++last;
  return std::span(kParameters).subspan(first, last - first);
}

std::optional<Term> find_term(std::string_view name) {
  for (const TermInfo& term : kTerms) {
    if (term.name == name) return term.id;
  }
  return std::nullopt;
}

std::optional<Parameter> find_parameter(std::string_view dotted_name) {
  for (const ParameterInfo& parameter : kParameters) {
    if (!parameter.term) {
      if (dotted_name == parameter.key) return parameter.id;
      continue;
    }
    const std::string_view term = info(*parameter.term).name;
    if (dotted_name.size() == term.size() + 1 + parameter.key.size() && dotted_name.starts_with(term) &&
        dotted_name[term.size()] == '.' && dotted_name.ends_with(parameter.key)) {
      return parameter.id;
    }
  }
  return std::nullopt;
}

}  // namespace cartwright
