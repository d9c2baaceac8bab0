#pragma once

#include "host/diagnose/fit/fit.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

/// A fitted number with its 95 % interval, within the range its physics has. The interval of what readings of
/// the cart can tell only together with something else holds all that the other usually is.
Estimate estimate(const Fit& fit, Parameter id);

/// The same number as `model` has it, which another criterion may have fitted; its interval then holds that
/// of the fit and as much on the other side.
Estimate estimate_of(const Model& model, const Fit& fit, Parameter id);

}  // namespace cartwright
