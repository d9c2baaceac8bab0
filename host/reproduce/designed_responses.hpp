#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Fig. 19: responses with Kp = 80, Kd = 10 and with Kp = 100, Kd = 0, of the cart, the linear and the
/// non-linear model: rise time and overshoot.
Result<Section> predicted_responses(const ReproduceOptions& options);

/// Fig. 20: gains for 0.1 % overshoot and 0.3 s rise time on NLm1, and what Lm1 would have predicted. The
/// paper does not print the gains; they are searched for over the whole range.
Result<Section> designed_response(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
