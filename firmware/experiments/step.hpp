#pragma once

#include <algorithm>
#include <cmath>

#include "firmware/experiments/demand.hpp"

namespace cartwright::firmware {

enum class StepPattern { single, alternating, ladder };

struct StepSetup {
  double amplitude_m = 0.1;
  StepPattern pattern = StepPattern::alternating;
  int levels = 4;  ///< of a ladder
  double delay_s = 0.2, interval_s = 1.5, duration_s = 6;
};

/// Steps of the reference from zero. The k-th interval after the delay (k = 0, 1, ...) holds
///   single       A
///   alternating  A for even k, 0 for odd k
///   ladder       A n/N with n = 1, 2, ... N, ... 1, 0, 1, ...
class Step {
 public:
  explicit Step(const StepSetup& setup = {}) : setup_(setup) {}

  double start_m() const noexcept { return 0; }
  double duration_s() const noexcept { return setup_.duration_s; }

  Demand at(double time_s, double /*measured_m*/) noexcept {
    if (time_s < setup_.delay_s) return {};
    const double k = std::floor((time_s - setup_.delay_s) / setup_.interval_s);
    return {setup_.amplitude_m * part(k)};
  }

 private:
  double part(double k) const noexcept {
    if (setup_.pattern == StepPattern::single) return 1;
    if (setup_.pattern == StepPattern::alternating) return std::fmod(k, 2) == 0 ? 1 : 0;
    const double levels = setup_.levels;
    const double place = std::fmod(k + 1, 2 * levels);
    return std::min(place, 2 * levels - place) / levels;
  }

  StepSetup setup_;
};

}  // namespace cartwright::firmware
