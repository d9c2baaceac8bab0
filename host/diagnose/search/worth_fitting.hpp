#pragma once

#include <vector>

#include "host/diagnose/search/explanation.hpp"

namespace cartwright {

/// A fit gains more than its start promises: up to 7 times in carts of all terms. (16 times for a flexible
/// coupling, but one that large is far above what it would have to promise.)
inline constexpr double kMostGainOverPromise = 10.0;
/// Two masses are fitted only where they promise to compete: at least this share of the best promise.
inline constexpr double kLeastShareOfTwoMasses = 0.25;

bool is_gap(const Promise& promise);

/// Of what was promised on top of `base`, best first: the terms and starts that may gain `least_gain` and
/// more than the rest, as many as there is time for.
std::vector<Promise> worth_fitting(const std::vector<Promise>& promises, double least_gain,
                                   const Explanation& base);

}  // namespace cartwright
