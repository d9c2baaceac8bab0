#pragma once

#include <cstddef>
#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// The recording that is kept out of everything: of a kind that is there more than once, not a relay test
/// and, if it can be, not a repeat, which the noise floor needs. None where there are fewer than four.
std::vector<std::size_t> choose_held_out(const Session& session);

Session without(const Session& session, const std::vector<std::size_t>& out);
Session only(const Session& session, const std::vector<std::size_t>& chosen);

}  // namespace cartwright
