#pragma once

#include <vector>

#include "common/result.hpp"
#include "host/relay/sine_problem.hpp"

namespace cartwright {

/// Frequencies from which a least-squares sine fit may start.
struct SineSeeds {
  std::vector<double> without_trend_hz, with_trend_hz;  ///< most promising first
  double highest_hz = 0;                                ///< half the sampling rate
};

/// Peaks of the least-squares periodogram: at each frequency, by how much a sine (beside an offset, or beside
/// an offset and a trend) lowers the sum of squares. From one zero-padded FFT: where there are few periods in
/// the record the sine is not orthogonal to offset and trend, and the exact 2 x 2 problem is solved instead
/// (closed-form sums for even sampling, sums over the samples otherwise). Uneven samples are put on the
/// nearest point of a grid of the median spacing; that is exact enough for a start, and nothing else uses it.
///
/// Fails where the times are so uneven that such a grid would be mostly empty.
Result<SineSeeds> sine_seeds(const SineProblem& problem);

}  // namespace cartwright
