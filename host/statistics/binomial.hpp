#pragma once

#include "host/statistics/estimate.hpp"

namespace cartwright {

/// A share seen in a count, and the interval that holds the true share with at least this probability
/// (Clopper and Pearson 1934, exact): its bounds are where chance would bring as many successes, or as few,
/// once in 2/(1 - probability). No trials: NaN, with [0, 1].
Estimate binomial_share(int successes, int trials, double probability = 0.95);

}  // namespace cartwright
