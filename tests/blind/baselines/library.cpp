#include "tests/blind/baselines/library.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/fit/candidates.hpp"

namespace cartwright::blind {
namespace {

constexpr int kCoggingFrequencies = 40;       // up to 20 periods on the way
constexpr int kEccentricityFrequencies = 16;  // up to 8
constexpr int kSpots = 8;

double sign(double x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

double beyond(double x, double limit) {
  return x - std::clamp(x, -limit, limit);
}

}  // namespace

Library::Library(const Session& session, const Model& nominal) {
  const SessionFacts facts = facts_of(session);
  travel_m_ = facts.travel_m(), low_m_ = facts.position_low_m;
  most_V_ = facts.most_voltage_V, typical_V_ = facts.typical_voltage_V;
  most_speed_m_per_s_ = facts.most_speed_m_per_s;
  back_emf_V_s_per_m_ = nominal[Parameter::viscous_coefficient] / nominal[Parameter::voltage_gain];
  coulomb_known_ = nominal.has(Term::coulomb_friction);
  columns({}, [&](const char* name, double) { names_.emplace_back(name); });
  nominal_ = coulomb_known_ ? 3 : 2;
}

template <typename Take>
void Library::columns(const Instant& at, const Take& take) const {
  const double v = at.v_m_per_s, u = at.u_V, y = at.y_m;
  take("voltage_gain", u);
  take("viscous_friction", v);
  take("coulomb_friction", sign(v));
  take("constant_force", 1);
  take("asymmetric_viscous_friction", std::abs(v));
  take("amplifier_gain_asymmetry", std::abs(u));
  take("quadratic_drag", v * std::abs(v));
  take("cable_spring", y);
  for (const double share : {0.02, 0.05, 0.1, 0.2})
    take("input_dead_zone", std::clamp(u, -share * typical_V_, share * typical_V_));
  for (const double share : {0.4, 0.6, 0.8}) take("voltage_saturation", beyond(u, share * most_V_));
  for (const double share : {0.3, 0.5, 0.7})
    take("current_limit", beyond(u - back_emf_V_s_per_m_ * v, share * most_V_));
  for (const double late : at.u_late_V) take("transport_delay", late - u);
  for (const double slow : at.u_slow_V) take("armature_lag", slow - u);
  for (const double share : {0.03, 0.1, 0.3}) {
    const double r = v / (share * most_speed_m_per_s_);
    take("stribeck_friction", sign(v) * std::exp(-r * r));
    take("exponential_damping", v * std::exp(-std::abs(r)));
  }
  for (const double time_s : {1.0, 3.0, 10.0}) take("motor_heating", u * (1 - std::exp(-at.t_s / time_s)));
  for (int i = 0; i < kSpots; ++i) {
    const double away = (y - low_m_) / travel_m_ * kSpots - i - 0.5;
    take("position_dependent_friction", sign(v) * std::exp(-away * away));
  }
  // A period must fit into the way twice, as the product has it.
  for (int i = 4; i <= kCoggingFrequencies; ++i) {
    const double phase = std::numbers::pi * i * y / travel_m_;
    take("cogging", std::sin(phase));
    take("cogging", std::cos(phase));
  }
  for (int i = 4; i <= kEccentricityFrequencies; ++i) {
    const double phase = std::numbers::pi * i * y / travel_m_;
    take("encoder_eccentricity", v * v * std::sin(phase));
    take("encoder_eccentricity", v * v * std::cos(phase));
  }
}

void Library::evaluate(const Instant& at, double* values) const {
  columns(at, [&](const char*, double value) { *values++ = value; });
}

}  // namespace cartwright::blind
