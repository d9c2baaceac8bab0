#include "host/identify/simulation_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

/// What a session shows, as rms values and extents.
struct Sizes {
  double voltage_V = 0, speed_m_per_s = 0, way_m = 0;
};

/// Speeds are read over this many rows, or encoder counts would pass for motion.
constexpr std::size_t kSpeedRows = 20;

Sizes sizes_of(const Session& session) {
  Sizes out;
  double voltage = 0, speed = 0, rows = 0, pairs = 0;
  for (const Recording& r : session.recordings) {
    if (r.size() == 0) continue;
    for (const double u : r.u_V) voltage += u * u;
    rows += static_cast<double>(r.size());
    for (std::size_t k = kSpeedRows; k < r.size(); k += kSpeedRows) {
      const double v = (r.y_m[k] - r.y_m[k - kSpeedRows]) / (r.t_s[k] - r.t_s[k - kSpeedRows]);
      speed += v * v;
      ++pairs;
    }
    const auto [low, high] = std::minmax_element(r.y_m.begin(), r.y_m.end());
    out.way_m = std::max(out.way_m, *high - *low);
  }
  if (rows > 0) out.voltage_V = std::sqrt(voltage / rows);
  if (pairs > 0) out.speed_m_per_s = std::sqrt(speed / pairs);
  return out;
}

/// Zero for what a fit by simulation leaves alone.
double scale_of(Parameter id, const Sizes& sizes, double gain) {
  using P = Parameter;
  const double push = std::abs(gain) * sizes.voltage_V, speed = sizes.speed_m_per_s;
  switch (id) {
    case P::voltage_gain:
      return std::abs(gain);
    case P::viscous_coefficient:
    case P::exponential_alpha1:
    case P::exponential_gamma:
      return push / speed;
    case P::exponential_alpha2:
      return 1 / speed;
    case P::coulomb_level:
    case P::stribeck_excess:
    case P::spot_peak:
    case P::constant_acceleration:
      return push;
    case P::stribeck_speed:
      return speed;
    case P::asymmetric_viscous_difference:
    case P::amplifier_gain_difference:
      return 1;
    case P::spot_centre:
    case P::spot_width:
    case P::spring_neutral:
      return sizes.way_m;
    case P::spring_stiffness:
      return push / sizes.way_m;
    case P::drag_coefficient:
      return push / (speed * speed);
    case P::dead_zone_half_width:
      return sizes.voltage_V;
    default:
      return 0;
  }
}

}  // namespace

std::vector<SlowParameter> slow_parameters(const Session& session, const Model& model,
                                           const std::vector<Parameter>& held) {
  const Sizes sizes = sizes_of(session);
  std::vector<SlowParameter> out;
  for (const ParameterInfo& parameter : parameters()) {
    const Parameter id = parameter.id;
    if (parameter.term && !model.has(*parameter.term)) continue;
    if (std::find(held.begin(), held.end(), id) != held.end()) continue;
    if (id == Parameter::spring_neutral && model.has(Term::constant_force)) continue;
    // A law that is switched off by zero stays so: damping of another term takes its place.
    if (id == Parameter::exponential_gamma && model[id] == 0 && model.has(Term::viscous_friction)) continue;
    const double scale = scale_of(id, sizes, model[Parameter::voltage_gain]);
    if (scale > 0 && std::isfinite(scale)) out.push_back({id, scale});
  }
  return out;
}

}  // namespace cartwright
