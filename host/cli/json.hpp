#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/statistics/estimate.hpp"

namespace cartwright::cli {

/// A number for JSON; what is not finite becomes null.
inline nlohmann::ordered_json number_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// `{"value": v, "low": a, "high": b}`; bounds the data does not give are null.
inline nlohmann::ordered_json estimate_json(const Estimate& estimate) {
  return {{"value", number_json(estimate.value)},
          {"low", number_json(estimate.low)},
          {"high", number_json(estimate.high)}};
}

}  // namespace cartwright::cli
