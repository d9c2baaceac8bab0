#pragma once

#include "host/diagnose/fit/candidates.hpp"
#include "host/diagnose/fit/fit.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// How far an encoder may turn about another axis than its own, in radii: its reading is then off by as much
/// of the way as it goes, at most (2 pi amplitude/period).
inline constexpr double kMostEccentricity = 0.3;
double eccentricity_of(const Model& model);

/// Whether an effect was fitted with numbers that its physics can have and that this session can show: away
/// from its bounds, a gap of a count at least, a period that the way holds twice, a push inside its
/// recording, friction of low speed or of a spot that is seen to fall off.
bool plausible(const Fit& fit, Term effect, const Session& session, const SessionFacts& facts);

}  // namespace cartwright
