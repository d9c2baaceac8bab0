#pragma once

#include "host/diagnose/search/explain.hpp"

namespace cartwright {

/// Whether the data tells the chosen of a contest from another term in its place. It does not where
///
/// - their likelihoods differ by less than chance would make them;
/// - the other gains `least_gain` too, what an effect must, and the difference is less than what neither
///   explains, `nats_left`: physics without a name may be all that makes it.
bool told_apart(const Contest& contest, const Explanation& other, double nats_left, double least_gain);

}  // namespace cartwright
