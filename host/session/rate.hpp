#pragma once

#include <string>

#include "common/result.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Whether two sample rates may belong to one session: within 10 %, as clocks and rounded rates differ.
bool same_rate(double one_hz, double other_hz);

/// Refuses a recording whose rows are further from 1/sample_rate_hz apart, by their median, than the share
/// `most_error` allows; `source` is how the message names the recording.
Result<void> check_rate(const Recording& recording, const Rig& rig, double most_error,
                        const std::string& source);

}  // namespace cartwright
