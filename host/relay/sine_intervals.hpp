#pragma once

#include "host/relay/sine_problem.hpp"
#include "host/relay/sinefit.hpp"

namespace cartwright {

/// How much the errors of a fit exceed those that white noise of the same power would cause.
struct NoiseColour {
  double near_sine = 1;  ///< factor on the variance of amplitude, phase and frequency
  double near_zero = 1;  ///< factor on the variance of offset and trend
  double degrees;        ///< degrees of freedom behind the variances
};

/// Compares the residual's density in the bins about f and about zero with that of white noise, where its
/// autocorrelation shows it not to be white. Never below one: a quiet neighbourhood may owe that to luck.
NoiseColour noise_colour(const SineProblem& problem, const std::vector<double>& residual, double frequency_hz,
                         double free_values);

/// Variance of amplitude (and, halved, of offset) that an encoder leaves when noise does not smooth it:
/// the fundamental of a quantised sine of amplitude A is off by up to about 0.4 q sqrt(q/A) however many
/// samples there are. Zero where the values are on no grid, or noise of more than half a step smooths it.
double quantisation_variance(std::span<const double> y, double amplitude, double residual_rms);

/// Fills the values and intervals of `fit` from the solution.
void fill_estimates(const SineProblem& problem, const SineProblem::Point& point, bool with_trend,
                    bool fixed_frequency, const NoiseColour& colour, double extra_variance, SineFit& fit);

/// Widens the intervals to the profile of the cost over frequency: all frequencies whose cost is not
/// significantly above the least. Returns the lowest of them [Hz]. For records of few periods, where the cost
/// is no parabola.
double widen_to_profile(const SineProblem& problem, const SineProblem::Point& point, bool with_trend,
                        const NoiseColour& colour, double highest_hz, SineFit& fit);

}  // namespace cartwright
