#pragma once

#include <span>
#include <vector>

#include "common/result.hpp"
#include "host/relay/sine_problem.hpp"

namespace cartwright {

/// An even grid of times for a transform: the samples' own where they are even, else one of their median
/// spacing, on whose nearest points they are put.
struct EvenGrid {
  static constexpr std::size_t kGreatest = std::size_t{1} << 21;
  double spacing_s = 1;
  std::size_t size = 0;
  bool even = true;

  explicit EvenGrid(const SineProblem& problem);
  /// The grid would be mostly empty.
  bool too_sparse() const { return size > kGreatest; }
  /// Then a wider spacing, for what needs only low frequencies.
  void coarsen(const SineProblem& problem);

  std::vector<float> spread(const SineProblem& problem, std::span<const double> values) const;
};

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
