#pragma once

#include <optional>

#include "common/model/model.hpp"
#include "host/relay/relay_identify.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// The relay tests of a session: last cycles of each with the fitted sine and the match in time, amplitudes
/// and frequencies, and what they say of the cart: as printed in the paper, by the corrected describing
/// function, by the match, and true.
void add_limit_cycles(Report& page, const Session& session, const RelayReport& relay,
                      const std::optional<Model>& truth);

}  // namespace cartwright::report
