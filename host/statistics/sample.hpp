#pragma once

#include <vector>

namespace cartwright {

/// The value that a share of all lies below; 0 of none.
double percentile(std::vector<double> values, double share);

/// 0 of none.
double root_mean_square(const std::vector<double>& values);

}  // namespace cartwright
