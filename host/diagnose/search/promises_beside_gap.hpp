#pragma once

#include <vector>

#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// What every term promises beside a gap. A gap that was found without what else is there has bent towards
/// it, and hides it: at those numbers the right term may promise least of all. Therefore the gap's numbers
/// first evolve beside smooth stand-ins that could take over what they make up for (drag, damping that
/// differs between directions, a Stribeck curve), whether or not those are what is there; then the stand-ins
/// are taken out, the gap stays where it was, and its errors show what is missing. Starts are from there.
std::vector<Promise> promises_beside_gap(const Session& session, const Fit& base, const SessionFacts& facts,
                                         const FitOptions& options, unsigned threads);

}  // namespace cartwright
