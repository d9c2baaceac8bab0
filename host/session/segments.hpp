#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cartwright {

/// Rows [first, last) of a recording without a gap between them.
struct Segment {
  std::size_t first = 0, last = 0;
  std::size_t size() const { return last - first; }
};

/// Splits a recording where rows are missing. The period is the median step of `t_s`; a step is a gap where
/// it is more than half a period longer than that (or than ten median deviations, for clocks that never were
/// regular) and the next step does not make up for it: a tick that came late is no gap.
std::vector<Segment> segments(std::span<const double> t_s);

/// The median step of strictly increasing times; zero for fewer than two.
double median_period_s(std::span<const double> t_s);

}  // namespace cartwright
