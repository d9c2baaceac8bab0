#pragma once

#include <string>
#include <vector>

#include "tests/blind/outcome.hpp"

namespace cartwright::blind {

/// What came out of many cases, as a table: names, false alarms and refusals by kind and size, the errors and
/// the coverage of parameters, the error removed on recordings nobody fitted, the time, and how often a name
/// was right against how sure it was.
std::string summary(const std::vector<Outcome>& outcomes);

}  // namespace cartwright::blind
