#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Table 1: least, mean and greatest voltage of the eight responses, with the loop as it is (sampled,
/// limited, the derivative sees the step) and with the ideal law of Eq. (62).
Result<Section> voltage_ranges(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
