#include "host/statistics/binomial.hpp"

#include <limits>

#include "host/statistics/distributions.hpp"

namespace cartwright {

Estimate binomial_share(int successes, int trials, double probability) {
  if (trials <= 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
  const double tail = 0.5 * (1 - probability);
  const double k = successes, n = trials;
  Estimate share{k / n, 0, 1};
  if (successes > 0) share.low = inverse_incomplete_beta(k, n - k + 1, tail);
  if (successes < trials) share.high = inverse_incomplete_beta(k + 1, n - k, 1 - tail);
  return share;
}

}  // namespace cartwright
