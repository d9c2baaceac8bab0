#pragma once

#include "host/session/session.hpp"

namespace cartwright {

/// Shares of a session, no repeats, for what would take too long on all of it: recordings in an order of
/// their own, until they last `most_s`.

/// Most reversals first, but not so many that one impact of a gap runs into the next.
Session most_reversals(const Session& session, double most_s);

/// One of each kind of experiment before a second of any: steps show the cart fly across a gap, relay tests
/// show it caught.
Session one_of_each_kind(const Session& session, double most_s);

}  // namespace cartwright
