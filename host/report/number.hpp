#pragma once

#include <string>

#include "host/statistics/estimate.hpp"

namespace cartwright::report {

using cartwright::Estimate;

/// A number as a page shows it: so many significant digits, a true minus sign, powers of ten written out for
/// what is very small or large, a dash for what is not a number.
std::string format_number(double value, int significant = 4);

struct FormattedEstimate {
  std::string value, interval;  ///< "1.913" and "[1.908, 1.918]"; no interval: empty
};

/// Value and bounds with the same decimals: as many as show two digits of the half-width, no more.
FormattedEstimate format_estimate(const Estimate& estimate);

}  // namespace cartwright::report
