#include "host/design/specification.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright::design {
namespace {

using Q = Quantity;
using M = StepMetrics;

constexpr double kLeastOvershoot = 1e-3;  // what an overshoot of zero is measured in

constexpr std::array<QuantityInfo, kQuantityCount> kQuantities{{
    {Q::settling_time, "settling_time_s", "settling time", "s", 1, &M::settling_time_s, false},
    {Q::overshoot, "overshoot", "overshoot", "%", 100, &M::overshoot, false},
    {Q::rise_time, "rise_time_s", "rise time", "s", 1, &M::rise_time_s, false},
    {Q::rms_voltage, "rms_voltage_V", "rms voltage", "V", 1, &M::rms_voltage_V, false},
    {Q::peak_voltage, "peak_voltage_V", "peak voltage", "V", 1, &M::peak_voltage_V, false},
    {Q::bandwidth, "bandwidth_hz", "bandwidth", "Hz", 1, &M::bandwidth_hz, true},
}};

}  // namespace

std::span<const QuantityInfo, kQuantityCount> quantities() {
  return kQuantities;
}

const QuantityInfo& info(Quantity quantity) {
  return kQuantities[static_cast<std::size_t>(quantity)];
}

double slack(Quantity quantity, double limit, const StepMetrics& metrics) {
  const QuantityInfo& q = info(quantity);
  const double value = metrics.*q.of;
  if (std::isnan(value)) return -std::numeric_limits<double>::infinity();
  const double scale = quantity == Q::overshoot ? std::max(limit, kLeastOvershoot) : limit;
  return (q.at_least ? value - limit : limit - value) / scale;
}

Verdict judge(const Specification& specification, const StepMetrics& metrics) {
  Verdict verdict;
  for (const QuantityInfo& q : kQuantities) {
    const auto& limit = specification[q.id];
    if (!limit) continue;
    const double left = slack(q.id, *limit, metrics);
    if (!verdict.binding || left < verdict.slack) verdict = {left, q.id};
  }
  return verdict;
}

}  // namespace cartwright::design
