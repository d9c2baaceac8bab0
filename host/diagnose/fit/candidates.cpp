#include "host/diagnose/fit/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "host/statistics/sample.hpp"

namespace cartwright {
namespace {

using P = Parameter;
using T = Term;

/// Starts at a kilohertz of something that goes with the rate to a power, and the same in ticks of the rig.
std::vector<double> at_both_rates(std::vector<double> starts, const SessionFacts& facts, double power) {
  constexpr double kOtherRate = 1.5;
  const double rate = facts.rate();
  if (rate < kOtherRate && rate > 1 / kOtherRate) return starts;
  for (std::size_t i = 0, usual = starts.size(); i < usual; ++i)
    starts.push_back(starts[i] * std::pow(rate, power));
  return starts;
}

/// A further wave of the cogging that the model does not have.
bool of_absent_wave(P parameter, const Model& model) {
  return std::any_of(kCoggingWaves.begin() + 1, kCoggingWaves.end(), [&](const PeriodicTerm& wave) {
    return model[wave.amplitude] == 0 && wave.has(parameter);
  });
}

/// What a presliding bristle has only by a law that the model's does not follow: damping, and its fading.
bool of_another_law(P parameter, const Model& model) {
  return (parameter == P::presliding_damping_ratio && model[P::presliding_dahl_exponent] == 0) ||
         (parameter == P::presliding_damping_speed && std::isinf(model[parameter]));
}

}  // namespace

SessionFacts facts_of(const Session& session) {
  std::vector<double> voltage;
  SessionFacts facts{motion_range_of(session.recordings)};
  facts.count_m = session.rig.encoder_resolution_m;
  facts.sample_rate_hz = session.rig.sample_rate_hz;
  for (const Recording& r : session.recordings) {
    for (const double u : r.u_V) voltage.push_back(std::abs(u));
    facts.longest_recording_s = std::max(facts.longest_recording_s, r.t_s.back() - r.t_s.front());
  }
  facts.most_voltage_V = percentile(voltage, 0.999);
  facts.typical_voltage_V = root_mean_square(voltage);
  return facts;
}

FreeParameter free_parameter(Parameter parameter, const SessionFacts& facts, const Model& model) {
  const ParameterInfo& entry = info(parameter);
  const double drive = std::abs(model[P::voltage_gain]) * facts.typical_voltage_V;  // m/s^2
  const double speed = std::max(facts.typical_speed_m_per_s, 1e-9);
  const double travel = std::max(facts.travel_m(), 1e-9);
  FreeParameter free{parameter, 1, entry.lower, entry.upper, false};
  const auto logarithmic = [&free](double lower, double upper) {
    free.logarithmic = true;
    free.lower = std::max(free.lower, lower);
    free.upper = std::min(free.upper, upper);
  };
  switch (parameter) {
    case P::voltage_gain:
      free.scale = std::abs(model[P::voltage_gain]);
      break;
    case P::viscous_coefficient:
    case P::exponential_alpha1:
    case P::exponential_gamma:
      free.scale = drive / speed;
      break;
    case P::exponential_alpha2:
      logarithmic(0.3 / facts.most_speed_m_per_s, 300 / facts.most_speed_m_per_s);
      break;
    case P::drag_coefficient:
      free.scale = drive / (speed * speed);
      break;
    case P::spring_stiffness:
      free.scale = drive / travel;
      break;
    case P::spring_neutral:
      free.scale = travel;
      free.lower = facts.position_low_m - travel;
      free.upper = facts.position_high_m + travel;
      break;
    case P::coulomb_level:
    case P::stribeck_excess:
    case P::constant_acceleration:
    case P::spot_peak:
    case P::cogging_amplitude:
    case P::cogging_second_amplitude:
    case P::cogging_third_amplitude:
    case P::disturbance_peak:
      free.scale = drive;
      break;
    case P::stribeck_speed:
      logarithmic(0.003 * facts.most_speed_m_per_s, facts.most_speed_m_per_s);
      break;
    case P::spot_centre:
      free.scale = 0.1 * travel;
      free.lower = facts.position_low_m;
      free.upper = facts.position_high_m;
      break;
    case P::spot_width:
      logarithmic(0.003 * travel, 0.5 * travel);
      break;
    case P::cogging_period:
    case P::cogging_second_period:
    case P::cogging_third_period:
    case P::eccentricity_period:
      logarithmic(1e-3 * travel, 2 * travel);
      break;
    case P::eccentricity_amplitude:
      free.scale = 3e-4 * travel;
      break;
    case P::backlash_gap:
      logarithmic(1e-6 * travel, 0.1 * travel);
      break;
    case P::dead_zone_half_width:
      free.scale = 0.1 * facts.typical_voltage_V;
      break;
    case P::saturation_limit:
      logarithmic(0.02 * facts.most_voltage_V, 1.5 * facts.most_voltage_V);
      break;
    case P::current_limit:
      logarithmic(0.02 * std::abs(model[P::voltage_gain]) * facts.most_voltage_V,
                  2 * std::abs(model[P::voltage_gain]) * facts.most_voltage_V);
      break;
    case P::armature_time_constant:
    case P::transport_delay:
      free.scale = 1e-3 / facts.slower();
      free.upper = std::min(free.upper, 0.05 / facts.slower());
      break;
    case P::coupling_resonance:
      logarithmic(2 * facts.slower(), 100 * facts.faster());
      break;
    case P::backlash_contact_resonance:
      logarithmic(50 * facts.slower(), 400 * facts.faster());  // at a kilohertz, stiffer teeth look the same
      break;
    case P::coupling_damping_ratio:
    case P::backlash_contact_damping_ratio:
      logarithmic(1e-3, 2);
      break;
    case P::coupling_load_share:
    case P::backlash_load_share:
      free.scale = 0.1;
      free.lower = 0.03;
      free.upper = 0.97;
      break;
    case P::heating_gain_loss:
      free.scale = 0.1;
      break;
    case P::heating_time_constant:
      logarithmic(0.05, 10 * facts.longest_recording_s);
      break;
    case P::presliding_damping_ratio:
      free.upper = 2;
      break;
    case P::presliding_damping_speed:
      logarithmic(1e-3 * facts.most_speed_m_per_s, facts.most_speed_m_per_s);
      break;
    case P::presliding_stiffness:
      logarithmic(1e2 * std::pow(facts.slower(), 2), 1e6 * std::pow(facts.faster(), 2));
      break;
    case P::disturbance_duration:
      logarithmic(0.005, facts.longest_recording_s);
      break;
    case P::disturbance_start:
      free.scale = 0.1;
      break;
    default:
      free.scale = 0.1;
      break;
  }
  return free;
}

std::vector<FreeParameter> free_parameters(const Model& model, const SessionFacts& facts) {
  std::vector<FreeParameter> free;
  for (const ParameterInfo& entry : parameters()) {
    if (entry.term && !model.has(*entry.term)) continue;
    // Speed threshold and rate of lost counts are read off the bursts, not fitted.
    if (entry.term == T::encoder_missed_counts) continue;
    if (entry.id == P::presliding_dahl_exponent) continue;  // a law, 0 or 1
    if (of_another_law(entry.id, model)) continue;
    if (of_absent_wave(entry.id, model)) continue;
    free.push_back(free_parameter(entry.id, facts, model));
  }
  return free;
}

std::vector<Candidate> candidates(const Model& model, const SessionFacts& facts) {
  std::vector<Candidate> list;
  const double drive = std::abs(model[P::voltage_gain]) * facts.typical_voltage_V;
  const auto add = [&](T term, std::vector<P> free, std::vector<std::vector<std::pair<P, double>>> starts) {
    if (model.has(term)) return;
    Candidate candidate{term, {}, std::move(starts)};
    for (const P id : free) {
      const FreeParameter& p = candidate.free.emplace_back(free_parameter(id, facts, model));
      for (auto& start : candidate.starts) {
        for (auto& [started, value] : start) {
          if (started == id) value = std::clamp(value, p.lower, p.upper);
        }
      }
    }
    list.push_back(std::move(candidate));
  };
  const double speed = facts.typical_speed_m_per_s, travel = facts.travel_m();
  const bool viscous = model.has(T::viscous_friction);
  const bool coulomb = model.has(T::coulomb_friction);

  if (!model.has(T::exponential_damping)) {
    add(T::viscous_friction, {P::viscous_coefficient}, {{{P::viscous_coefficient, 0.1 * drive / speed}}});
  }
  add(T::coulomb_friction, {P::coulomb_level}, {{{P::coulomb_level, 0.03 * drive}}});
  add(T::constant_force, {P::constant_acceleration}, {{{P::constant_acceleration, 0.02 * drive}}});
  if (viscous) {
    add(T::asymmetric_viscous_friction, {P::asymmetric_viscous_difference},
        {{{P::asymmetric_viscous_difference, 0.03}}});
    std::vector<std::vector<std::pair<P, double>>> limits;
    for (const double share : {0.2, 0.4, 0.6, 0.8}) {
      limits.push_back({{P::current_limit, share * std::abs(model[P::voltage_gain]) * facts.most_voltage_V}});
    }
    add(T::current_limit, {P::current_limit}, limits);
  }
  add(T::amplifier_gain_asymmetry, {P::amplifier_gain_difference}, {{{P::amplifier_gain_difference, 0.02}}});
  add(T::quadratic_drag, {P::drag_coefficient}, {{{P::drag_coefficient, 0.03 * drive / (speed * speed)}}});
  std::vector<std::vector<std::pair<P, double>>> springs;
  const double middle = 0.5 * (facts.position_low_m + facts.position_high_m);
  for (const double offset : {0.0, 0.3, -0.3}) {
    springs.push_back(
        {{P::spring_stiffness, 0.05 * drive / travel}, {P::spring_neutral, middle + offset * travel}});
  }
  add(T::cable_spring, {P::spring_stiffness, P::spring_neutral}, springs);
  add(T::input_dead_zone, {P::dead_zone_half_width},
      {{{P::dead_zone_half_width, 0.02 * facts.typical_voltage_V}},
       {{P::dead_zone_half_width, 0.1 * facts.typical_voltage_V}}});
  std::vector<std::vector<std::pair<P, double>>> saturations;
  for (const double share : {0.3, 0.5, 0.7, 0.9}) {
    saturations.push_back({{P::saturation_limit, share * facts.most_voltage_V}});
  }
  add(T::voltage_saturation, {P::saturation_limit}, saturations);
  std::vector<std::vector<std::pair<P, double>>> lags, delays, stribecks, exponentials, heatings, elastics,
      dahls, fadings, gaps, couplings, spots;
  for (const double late_s : at_both_rates({0.0005, 0.003}, facts, -1)) {
    lags.push_back({{P::armature_time_constant, late_s}});
    delays.push_back({{P::transport_delay, late_s}});
  }
  add(T::armature_lag, {P::armature_time_constant}, lags);
  add(T::transport_delay, {P::transport_delay}, delays);
  for (const double share : {0.03, 0.1, 0.3}) {
    const double v = share * facts.most_speed_m_per_s;
    stribecks.push_back({{P::stribeck_excess, 0.03 * drive}, {P::stribeck_speed, v}});
    exponentials.push_back({{P::exponential_alpha1, 0.05 * drive / v},
                            {P::exponential_alpha2, 1 / v},
                            {P::exponential_gamma, 0}});
  }
  add(T::stribeck_friction, {P::stribeck_excess, P::stribeck_speed}, stribecks);
  add(T::exponential_damping, {P::exponential_alpha1, P::exponential_alpha2}, exponentials);
  for (const double share : {0.2, 0.6, 3.0}) {
    heatings.push_back(
        {{P::heating_gain_loss, 0.02}, {P::heating_time_constant, share * facts.longest_recording_s}});
  }
  add(T::motor_heating, {P::heating_gain_loss, P::heating_time_constant}, heatings);
  if (coulomb) {
    for (const double stiffness : at_both_rates({3e3, 1e4, 3e4, 1e5}, facts, 2)) {
      elastics.push_back({{P::presliding_stiffness, stiffness}});
      for (const double damping_ratio : {0.05, 0.5}) {
        dahls.push_back({{P::presliding_stiffness, stiffness},
                         {P::presliding_dahl_exponent, 1},
                         {P::presliding_damping_ratio, damping_ratio}});
      }
      fadings.push_back(dahls.back());
      fadings.back().emplace_back(P::presliding_damping_speed, 0.03 * facts.most_speed_m_per_s);
    }
    add(T::presliding_friction, {P::presliding_stiffness}, elastics);
    const bool two_masses =
        model.has(T::backlash) || model.has(T::flexible_coupling);  // have no such bristle
    if (!two_masses) {
      add(T::presliding_friction, {P::presliding_stiffness, P::presliding_damping_ratio}, dahls);
      add(T::presliding_friction,
          {P::presliding_stiffness, P::presliding_damping_ratio, P::presliding_damping_speed}, fadings);
    }
  }
  for (double gap = 4 * facts.least_way_m(); gap < 0.03 * travel && gaps.size() < 6; gap *= 2.5) {
    gaps.push_back({{P::backlash_gap, gap},
                    {P::backlash_load_share, 0.5},
                    {P::backlash_load_damping_share, 0.3},
                    {P::backlash_contact_resonance, 150 * facts.slower()},
                    {P::backlash_contact_damping_ratio, 0.25}});
  }
  add(T::backlash,
      {P::backlash_gap, P::backlash_load_share, P::backlash_load_friction_share,
       P::backlash_load_damping_share, P::backlash_contact_resonance, P::backlash_contact_damping_ratio},
      gaps);
  for (const double resonance : at_both_rates({5, 9, 16, 28, 50}, facts, 1)) {
    for (const double share : {0.3, 0.6}) {
      couplings.push_back({{P::coupling_resonance, resonance},
                           {P::coupling_damping_ratio, 0.05},
                           {P::coupling_load_share, share}});
    }
  }
  add(T::flexible_coupling,
      {P::coupling_resonance, P::coupling_damping_ratio, P::coupling_load_share,
       P::coupling_load_friction_share, P::coupling_load_damping_share},
      couplings);
  constexpr int kSpots = 12;
  for (int i = 0; i < kSpots; ++i) {
    const double centre = facts.position_low_m + (i + 0.5) / kSpots * travel;
    spots.push_back(
        {{P::spot_peak, 0.1 * drive}, {P::spot_centre, centre}, {P::spot_width, 0.5 / kSpots * travel}});
  }
  add(T::position_dependent_friction, {P::spot_peak, P::spot_centre, P::spot_width}, spots);
  return list;
}

Model with_start(Model model, const std::vector<std::pair<Parameter, double>>& start) {
  for (const auto& [id, value] : start) model.set(id, value);
  return model;
}

}  // namespace cartwright
