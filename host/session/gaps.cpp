#include "host/session/gaps.hpp"

#include <cmath>

namespace cartwright {

std::vector<Gap> find_gaps(const std::vector<double>& time_s, double period_s) {
  std::vector<Gap> gaps;
  for (std::size_t row = 1; row < time_s.size(); ++row) {
    const double periods = (time_s[row] - time_s[row - 1]) / period_s;
    if (periods > kGapPeriods) gaps.push_back({row, time_s[row - 1], time_s[row], std::round(periods) - 1});
  }
  return gaps;
}

}  // namespace cartwright
