#pragma once

#include <string>

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// What stays unexplained: where it is, the push along the axis that carries most of it, and what came
/// closest; `why_refused` says why that is no explanation, empty where it is one of a part.
Unexplained left_over(const Diagnosis& diagnosis, double share_left, const std::string& why_refused);

}  // namespace cartwright
