#include "host/identify/force_units.hpp"

#include <array>
#include <string_view>

namespace cartwright {
namespace {

struct Unit {
  std::string_view acceleration, force;  ///< endings of a key
};
// The longer ending first: a speed, m_per_s, is no damping, per_s.
constexpr std::array<Unit, 5> kUnits{{{"_m_per_s2", "_N"},
                                      {"_m_per_s", ""},
                                      {"_per_s2", "_N_per_m"},
                                      {"_per_s", "_N_s_per_m"},
                                      {"_per_m", "_N_s2_per_m2"}}};

}  // namespace

std::optional<std::string> force_name(Parameter parameter, const ForceScale& scale) {
  if (parameter == Parameter::voltage_gain) return scale.drive_N_per_V ? "moving_mass_kg" : "drive_N_per_V";
  // How often counts are lost, how much longer a time is at speed: no forces, whatever their endings.
  if (parameter == Parameter::missed_rate || parameter == Parameter::exponential_alpha2) return {};
  if (parameter == Parameter::constant_acceleration) return "constant_force.force_N";
  const std::string name = dotted_name(parameter);
  for (const Unit& unit : kUnits) {
    if (!name.ends_with(unit.acceleration)) continue;
    if (unit.force.empty()) return {};
    return name.substr(0, name.size() - unit.acceleration.size()).append(unit.force);
  }
  return {};
}

double force_value(Parameter parameter, const ForceScale& scale, const Model& model) {
  const double mass_kg = scale.moving_mass_kg(model);
  if (parameter == Parameter::voltage_gain && scale.drive_N_per_V) return mass_kg;
  return mass_kg * model[parameter];
}

}  // namespace cartwright
