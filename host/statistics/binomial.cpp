#include "host/statistics/binomial.hpp"

#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

/// The x at which the increasing function I_x(a, b) reaches `level`.
double inverse_incomplete_beta(double level, double a, double b) {
  double low = 0, high = 1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (incomplete_beta(a, b, middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Estimate binomial_share(int successes, int trials, double probability) {
  if (trials <= 0) return {std::numeric_limits<double>::quiet_NaN(), 0, 1};
  const double tail = 0.5 * (1 - probability);
  const double k = successes, n = trials;
  Estimate share{k / n, 0, 1};
  if (successes > 0) share.low = inverse_incomplete_beta(tail, k, n - k + 1);
  if (successes < trials) share.high = inverse_incomplete_beta(1 - tail, k + 1, n - k);
  return share;
}

}  // namespace cartwright
