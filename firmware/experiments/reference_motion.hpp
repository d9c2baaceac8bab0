#pragma once

#include <type_traits>

#include "common/control/feedforward.hpp"
#include "firmware/experiments/sweep.hpp"
#include "firmware/experiments/track.hpp"

namespace cartwright::firmware {

/// The reference in the middle of the hold that starts at a time, and how it moves there: differences over
/// that hold. Where a reference jumps or stands still (step, hold, dither, relay) it does not move.
template <typename Experiment>
ReferenceMotion reference_motion(Experiment& experiment, double time_s, double period_s) noexcept {
  const double r0 = experiment.at(time_s, 0).reference_m;
  const double r1 = experiment.at(time_s + 0.5 * period_s, 0).reference_m;
  const double r2 = experiment.at(time_s + period_s, 0).reference_m;
  return {r1, (r2 - r0) / period_s, (r2 - 2 * r1 + r0) / (0.25 * period_s * period_s)};
}

/// Whether an experiment's reference moves smoothly, and its `at` depends on nothing but the time.
template <typename Experiment>
inline constexpr bool kSmooth = std::is_same_v<Experiment, Track> || std::is_same_v<Experiment, Sweep>;

}  // namespace cartwright::firmware
