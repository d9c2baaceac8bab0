#pragma once

#include <string>
#include <vector>

#include "host/diagnose/fit/candidates.hpp"

namespace cartwright {

/// How strongly the one-step errors of a fit answer along an axis that no bins fit: a frequency or a lag.
struct Profile {
  std::string axis;           ///< `spatial_frequency_per_m`, `frequency_hz` or `input_lag_s`
  std::vector<double> at;     ///< points of the axis, in its unit
  std::vector<double> value;  ///< gains [nats] of a line there; over lags correlations, of either sign
  double band = 0;            ///< what chance alone reaches anywhere on the axis in 1 session of 20
  double bar = 0;             ///< in 1 of 20 000: below it the axis is flat
  double share = 0;           ///< of the squared errors that the strongest point explains

  std::size_t strongest() const;
  /// Indices of the peaks above the bar, strongest first; none within a few points of a stronger one, whose
  /// foot it would be.
  std::vector<std::size_t> lines(std::size_t most) const;
  bool flat() const;
};

/// A push that repeats over the way (position_spectrum.hpp).
Profile spatial_frequency_profile(const Session& session, const Fit& fit, const FitOptions& options,
                                  unsigned threads);

/// A line in time: the periodograms of all recordings together, 1 to 150 Hz. Under white errors their sum
/// over R recordings is one of R unit exponentials; the gain is the Chernoff bound of its tail. The steps of
/// an encoder colour errors: powers count relative to those of `alike_m` a few hertz around, the errors (a
/// row for each of the fit's) of a cart that is exactly the model, and its lines lift the bar.
Profile frequency_profile(const Session& session, const Fit& fit, const std::vector<double>& alike_m);

/// A line, or an axis, stands out from what a cart that is exactly the model shows by so much at least.
inline constexpr double kStandsOutFromAlike = 2;

/// Correlation of the errors with the change of the voltage so long before: what arrives late shows here.
Profile input_lag_profile(const Session& session, const Fit& fit);

}  // namespace cartwright
