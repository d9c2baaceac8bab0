#pragma once

#include "host/statistics/estimate.hpp"

namespace cartwright::test {

inline bool covers(const Estimate& estimate, double truth) {
  return estimate.low <= truth && truth <= estimate.high;
}

}  // namespace cartwright::test
