#pragma once

#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright::blind {

/// Sparse regression of dynamics (SINDy) with the vocabulary as its library, by derivatives: position
/// smoothed over 11 ms, speed and acceleration by differences of it, the voltage under the same means as the
/// acceleration, one row every 5 ms. STLSQ, its threshold cross-validated over recordings. Rows at rest are
/// left out: there friction equals whatever is applied. Names the terms that stay beyond the nominal ones,
/// first the one whose loss would hurt most; it names nothing where nothing stays.
std::vector<std::string> sparse_by_derivatives(const Session& session, const Model& nominal);

/// The same in weak form (Messenger and Bortz 2021): both sides integrated against bumps (1 - s^2)^4 of 100
/// ms, the acceleration moved onto the bump by parts, so that nothing is differentiated twice and the held
/// voltage enters as it was held. Windows in which the cart rests are left out.
std::vector<std::string> sparse_in_weak_form(const Session& session, const Model& nominal);

}  // namespace cartwright::blind
