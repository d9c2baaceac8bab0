#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "host/design/step_metrics.hpp"

namespace cartwright::design {

enum class Quantity { settling_time, overshoot, rise_time, rms_voltage, peak_voltage, bandwidth };
inline constexpr std::size_t kQuantityCount = 6;

struct QuantityInfo {
  Quantity id;
  std::string_view name;    ///< as in JSON: the unit is its last part
  std::string_view words;   ///< as in a sentence
  std::string_view unit;    ///< as people read it
  double shown_per_si = 1;  ///< per cent for the overshoot
  double StepMetrics::*of;
  bool at_least;  ///< the limit is a least value
};

std::span<const QuantityInfo, kQuantityCount> quantities();
const QuantityInfo& info(Quantity quantity);

/// What a step response must keep to; absent limits are not asked for.
struct Specification {
  double settling_band = 0.02;  ///< of the step
  std::array<std::optional<double>, kQuantityCount> limits{};

  std::optional<double>& operator[](Quantity q) { return limits[static_cast<std::size_t>(q)]; }
  const std::optional<double>& operator[](Quantity q) const { return limits[static_cast<std::size_t>(q)]; }
};

/// How much of its limit a quantity has left: (limit - value)/limit, or (value - limit)/limit where the limit
/// is a least value. Negative where the limit is broken, -infinity where the value does not exist (a response
/// that does not settle). An overshoot limit of zero leaves 1 - value/0.1 %.
double slack(Quantity quantity, double limit, const StepMetrics& metrics);

/// The limit with the least slack.
struct Verdict {
  double slack = std::numeric_limits<double>::infinity();
  std::optional<Quantity> binding;  ///< none where nothing is specified
  bool met() const { return slack >= 0; }
};

Verdict judge(const Specification& specification, const StepMetrics& metrics);

}  // namespace cartwright::design
