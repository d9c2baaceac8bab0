#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Table 3 and Section 4.5: the integral method and ordinary non-linear least squares (host/regression) on
/// the same response in the same run: time, accuracy, and starts from which regression fails.
Result<Section> against_regression(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
