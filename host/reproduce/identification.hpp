#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Eq. (64), (75), (76): constant damping from one response of each simulated cart. Eq. (73), (77), (78): six
/// damping values with Eq. (65) and their law against speed; beside the corrected forms of Eq. (65) and (66)
/// the printed ones. Every value with its spread over draws of encoder phase and noise.
Result<Section> identified_carts(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
