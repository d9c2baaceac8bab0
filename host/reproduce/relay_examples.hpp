#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Sections 3.2 of the sinefit memo and 4 of the relay paper: limit cycles of the paper's plant from an exact
/// stick-slip simulation (relay sampled at 5 kHz, no encoder), the equations as printed and corrected, and
/// the exact match.
Result<Section> relay_identification(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
