#pragma once

#include "host/session/session.hpp"

namespace cartwright {

/// One session of two: the recordings of `before`, then those of `more`, one of the same file in place of the
/// older; the wider of both travels and voltage limits. Fails where they cannot be of one rig: sample rates
/// more than a tenth apart, or different encoders.
Result<Session> joined(Session before, Session more);

}  // namespace cartwright
