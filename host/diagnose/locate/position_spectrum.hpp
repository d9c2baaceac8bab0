#pragma once

#include <vector>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/fit/candidates.hpp"

namespace cartwright {

/// What is missing as a sine over the way, for one spatial frequency k/(2 pi): the least-squares fit of
/// a sin(k y) + b cos(k y) to the errors of a fit, through what its observer shows (influence.hpp), the fit's
/// own numbers refitted alongside.
struct Wave {
  double gain = 0;              ///< log-likelihood gained [nats]
  double sine = 0, cosine = 0;  ///< a, b: of a push [m/s^2], or of the reading [m]
};

/// Waves on an even grid of spatial frequencies, from two of its steps up to the finest that speed and travel
/// resolve; steps are a share of 1/travel, so no line falls between.
struct PositionSpectrum {
  double step_per_m = 0;
  std::vector<Wave> push;     ///< of a push
  std::vector<Wave> reading;  ///< of the encoder's error; empty where not asked for

  double frequency_per_m(std::size_t i) const { return step_per_m * static_cast<double>(i + 2); }
  /// The first wave that the travel holds twice: a longer one bends like a straight line, and is not told
  /// from scale and offset.
  std::size_t first_told_apart() const;
};

enum class Waves { of_push, of_push_and_reading };
PositionSpectrum position_spectrum(const Session& session, const Fit& base, const SessionFacts& facts,
                                   const FitOptions& options, Waves waves, unsigned threads);

}  // namespace cartwright
