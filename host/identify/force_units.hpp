#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

/// What turns the accelerations of a model into forces. A model is divided by its moving mass M, so that
/// recordings alone never give M; one number from outside does:
///
///     M = F / beta     F: force of the drive per volt [N/V], beta: voltage gain [m/s^2/V]
///
/// or M itself, weighed, which gives F = M beta. Exactly one of the two is set.
struct ForceScale {
  std::optional<double> drive_N_per_V;
  std::optional<double> mass_kg;

  double moving_mass_kg(const Model& model) const {
    return drive_N_per_V ? *drive_N_per_V / model[Parameter::voltage_gain] : *mass_kg;
  }
};

/// A parameter as a force: `term.key` with the unit of the force, its 95 % interval from the same resampling
/// as the parameter's own, so that what gain and friction share does not count twice.
struct ForceEstimate {
  std::string name;
  Estimate estimate;
};

/// The name of a parameter that is an acceleration over speed, position or neither, times the mass:
/// m/s^2 becomes N, 1/s N s/m, 1/s^2 N/m, 1/m N s^2/m^2. The voltage gain is named after what the scale
/// leaves open, moving mass or drive. None for parameters that are no force (lengths, times, shares).
std::optional<std::string> force_name(Parameter parameter, const ForceScale& scale);

/// The number that goes with the name.
double force_value(Parameter parameter, const ForceScale& scale, const Model& model);

}  // namespace cartwright
