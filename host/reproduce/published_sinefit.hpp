#pragma once

#include <functional>
#include <span>

namespace cartwright::reproduce {

/// Least of a function on [low, high] by golden sections and parabolas (Brent; MATLAB's `fmin` of the paper):
/// finds a local minimum, whichever it happens to close in on.
double brent_minimum(const std::function<double(double)>& cost, double low, double high, double tolerance);

/// The script sinefit.m as published: no offset, frequency searched by `fmin` on [0.5, 2] times the rough
/// one.
struct PublishedSineFit {
  double amplitude = 0, frequency_hz = 0, phase_rad = 0;
  double rms = 0;  ///< with n - 1, as printed
};

PublishedSineFit published_sinefit(std::span<const double> t_s, std::span<const double> y, double rough_hz);

/// sinefit2.m: the frequency is given.
PublishedSineFit published_sinefit2(std::span<const double> t_s, std::span<const double> y,
                                    double frequency_hz);

}  // namespace cartwright::reproduce
