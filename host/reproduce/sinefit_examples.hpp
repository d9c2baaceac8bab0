#pragma once

#include "host/reproduce/reproduction.hpp"

namespace cartwright::reproduce {

/// Section 3.1 of the sinefit memo on a simulated relay record.
Result<Section> relay_record_example(const ReproduceOptions& options);

/// Section 3.3: the published search and ours on the same noise draws; bias, variance against the Cramer-Rao
/// bound, and how often each ends on a side lobe (further than 1/(record length) from the truth).
Result<Section> noise_examples(const ReproduceOptions& options);

}  // namespace cartwright::reproduce
