#pragma once

#include <span>

#include "host/session/session.hpp"

namespace cartwright {

/// How far apart the rows of a recording are [s], and how often some are missing.
struct RowSpacing {
  double least_s = 0, median_s = 0, most_s = 0;  ///< between rows that follow each other
  std::size_t gaps = 0;

  /// Whether a program that takes the rows to be evenly spaced would be wrong by more than a tenth somewhere.
  bool even() const { return most_s <= 1.1 * median_s && least_s >= 0.9 * median_s; }
};
RowSpacing row_spacing(std::span<const double> t_s);

/// The same motion on an even grid of times, t = t(0) + k / rate. Positions, references and other columns are
/// interpolated by straight lines between the rows around; u_V and d_V, which hold until the next row, are
/// averaged over each new tick, so that what they push is the same. Nothing is made up inside a gap: rows
/// that would lie there are left out, and the gap stays one (segments.hpp; rows no further apart than one and
/// a half new ticks are no gap, for clocks that change their rate).
Recording even_rows(const Recording& recording, double rate_hz);

}  // namespace cartwright
