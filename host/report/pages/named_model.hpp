#pragma once

#include <string>

#include "common/model/model.hpp"
#include "host/report/plot.hpp"

namespace cartwright::report {

/// A model as it appears in legends and tables.
struct NamedModel {
  std::string name;
  Model model;
  Colour colour = Colour::model;
};

}  // namespace cartwright::report
