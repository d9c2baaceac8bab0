#pragma once

#include <string>

#include "common/model/model.hpp"

namespace cartwright {

/// An effect as a sentence with its numbers and units.
std::string statement(Term term, const Model& model);

}  // namespace cartwright
