#pragma once

#include "host/session/session.hpp"

namespace cartwright::cli {

/// Says on standard error, a line for each recording, where rows are missing: nobody is to take numbers from
/// such a recording for those of a whole one.
void tell_gaps(const Session& session);

}  // namespace cartwright::cli
