#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/model/model.hpp"
#include "common/result.hpp"

namespace cartwright {

/// A 95 % interval of one number of a model.
struct ParameterInterval {
  Parameter id = Parameter::voltage_gain;
  double low = 0, high = 0;
};

/// `[intervals]` of a model file, as `identify` and `diagnose` write it:
///
///     [intervals]
///     "voltage_gain_m_per_s2_V" = [1.92, 1.94]
///     "viscous_friction.coefficient_per_s" = [4.9, 5.2]
///
/// Empty where there is no such table. An entry whose bounds are nan (the data gave none) is left out; an
/// unknown name, a term the model does not have, and bounds the wrong way round are errors.
Result<std::vector<ParameterInterval>> intervals_from_toml(std::string_view text, std::string_view source,
                                                           const Model& model);

/// The table's text, with a line of explanation; entries without finite bounds are left out, and nothing
/// remains of an empty list.
std::string intervals_to_toml(std::span<const ParameterInterval> intervals);

}  // namespace cartwright
