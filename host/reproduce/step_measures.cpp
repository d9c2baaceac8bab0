#include "host/reproduce/step_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cartwright::reproduce {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

double reaches_s(const std::vector<double>& y, double period_s, double level) {
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (y[i] >= level) {
      return period_s * (static_cast<double>(i) - (y[i] - level) / (y[i] - y[i - 1]));
    }
  }
  return kNever;
}

StepMeasures measure_step(const std::vector<double>& y, double period_s, double final_value, double band) {
  StepMeasures out;
  out.rise_s = reaches_s(y, period_s, 0.9 * final_value) - reaches_s(y, period_s, 0.1 * final_value);
  out.overshoot = std::max(0.0, *std::max_element(y.begin(), y.end()) / final_value - 1);
  const auto outside = [&](double value) { return std::abs(value - final_value) > band * final_value; };
  std::size_t last = y.size();
  while (last > 0 && !outside(y[last - 1])) --last;
  if (last == y.size()) {
    out.settling_s = kNever;
  } else if (last > 0) {
    const double edge = final_value * (1 + std::copysign(band, y[last - 1] - final_value));
    out.settling_s =
        period_s * (static_cast<double>(last - 1) + (edge - y[last - 1]) / (y[last] - y[last - 1]));
  }
  return out;
}

}  // namespace cartwright::reproduce
