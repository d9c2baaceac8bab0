#pragma once

#include <string>
#include <vector>

#include "common/result.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// What is said about a session before anything is concluded from it. Refused, with the reason in one line: a
/// session in which nothing moves, and rows whose distance in time contradicts `sample_rate_hz`. Otherwise
/// the recordings that show little: those that never move and those whose command sits at its limit
/// throughout.
Result<std::vector<std::string>> check_hygiene(const Session& session);

}  // namespace cartwright
