#pragma once

#include <string>
#include <vector>

#include "common/config/interval_toml.hpp"
#include "common/model/model.hpp"
#include "host/report/plot.hpp"

namespace cartwright::report {

/// A model as it appears in legends and tables.
struct NamedModel {
  std::string name;
  Model model;
  Colour colour = Colour::model;
  std::vector<ParameterInterval> intervals{};  ///< of the numbers that have one
};

}  // namespace cartwright::report
