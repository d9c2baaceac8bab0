#pragma once

#include <string>
#include <vector>

#include "common/model/model.hpp"

namespace cartwright {

/// An effect as a sentence with its numbers and units.
std::string statement(Term term, const Model& model);

/// That pushes with these periods stand above chance without a name; empty where there are none.
std::string statement_of_periods(const std::vector<double>& periods_m);

}  // namespace cartwright
