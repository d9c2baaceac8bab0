#pragma once

#include <string>

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// `diagnosis.json`: verdict, effects, parameters, fit, what is unexplained, the maps behind it, and what to
/// run next.
std::string to_json(const Diagnosis& diagnosis);

/// `model.toml`: the model, and beside it each fitted number's interval and flags in a table that readers of
/// models pass over.
std::string model_with_intervals(const Diagnosis& diagnosis);

/// `missing_force.csv`: what no term explains as a table, a row per bin of the axis that carries it: its
/// edges, the missing push and the half width of its 95 % band [m/s^2]. On odd maps a positive push acts
/// against the motion.
std::string missing_force_csv(const Unexplained& left);

}  // namespace cartwright
