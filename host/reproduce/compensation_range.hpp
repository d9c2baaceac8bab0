#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// By how much friction compensation cuts the tracking error of a 0.5 Hz sine, over encoder step and noise,
/// on the cart and on the linear motor; and an hour of the adaptive law with noise, friction growing by half
/// after thirty minutes.
Result<Section> compensation_range(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
