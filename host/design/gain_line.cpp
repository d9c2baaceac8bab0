#include "host/design/gain_line.hpp"

namespace cartwright::design {
namespace {

/// Where the answer changes between `from`, whose answer is `answer`, and `to`: the first change of each
/// grid.
double edge(const std::function<bool(double)>& yes, double from, double to, bool answer) {
  constexpr int kParts = 8;
  for (int level = 0; level < 3; ++level) {
    const double step = (to - from) / kParts;
    for (int i = 1; i <= kParts; ++i) {
      if (i < kParts && yes(from + step * i) == answer) continue;
      to = from + step * i;
      from = to - step;
      break;
    }
  }
  return answer ? from : to;  // on the side of yes
}

}  // namespace

std::vector<GainInterval> yes_intervals(const std::function<bool(double)>& yes, double least, double most,
                                        int points) {
  std::vector<GainInterval> found;
  bool before = false;
  double last = least;
  for (int i = 0; i < points; ++i) {
    const double gain = least + (most - least) * i / (points - 1);
    const bool now = yes(gain);
    if (now && !before) found.push_back({i == 0 ? gain : edge(yes, last, gain, false), gain});
    if (now) found.back().high = gain;
    if (!now && before) found.back().high = edge(yes, last, gain, true);
    before = now;
    last = gain;
  }
  return found;
}

std::vector<GainInterval> derivative_gains(const Model& model, const Loop& loop, const StepTest& test,
                                           const Specification& specification, const Gains& others,
                                           double least, double most, int points) {
  StepTest wanted = test;
  wanted.settling_band = specification.settling_band;
  wanted.bandwidth = specification[Quantity::bandwidth].has_value();
  return yes_intervals(
      [&](double kd) {
        Gains gains = others;
        gains.kd_V_s_per_m = kd;
        return judge(specification, step_metrics(model, gains, loop, wanted)).met();
      },
      least, most, points);
}

std::optional<double> least_derivative_gain(const Model& model, const Loop& loop, const StepTest& test,
                                            const Specification& specification, double kp_V_per_m,
                                            double most_kd_V_s_per_m) {
  const auto found =
      derivative_gains(model, loop, test, specification, {.kp_V_per_m = kp_V_per_m}, 0, most_kd_V_s_per_m);
  if (found.empty()) return std::nullopt;
  return found.front().low;
}

}  // namespace cartwright::design
