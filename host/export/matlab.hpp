#pragma once

#include <string>

#include "common/result.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// A session as a MATLAB version 5 file, compressed, which `load` and scipy.io.loadmat read.
///
/// Variables: `rig` (name, sample_rate_hz, encoder_resolution_m, voltage_limit_V, travel_m) and one struct
/// per recording, named after its file: every column as a column vector (names made identifiers, empty cells
/// NaN), and `file`, `experiment`, `repeat_of`, `controller` (a struct with `type` and the gains; empty where
/// there is none) and `losses_s`, one row `[from to]` per stretch of lost rows.
Result<std::string> to_matlab(const Session& session);

}  // namespace cartwright
