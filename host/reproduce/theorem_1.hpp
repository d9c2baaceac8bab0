#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Theorem 1 and Corollary 2 as an experiment on Eq. (30)-(32): y'' + (0.9 + 0.7 t) y' + 30 y = 0. Damping
/// models that alternate as Eq. (39)-(41) do, and least squares from data that is off by at most epsilon,
/// without and with the slope bound of Eq. (47), over k = 5 to 400 intervals.
Result<Section> damping_identifiability(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
