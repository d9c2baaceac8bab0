#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Table 2: mean absolute prediction errors of three linear and three non-linear models for eight pairs of
/// gains. The models are identified here, each from one response at one Kp; the cart of a row is the
/// published non-linear model of its Kp. Beside them, the averages of the published models and of Eq. (62) as
/// printed.
Result<Section> prediction_errors(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
