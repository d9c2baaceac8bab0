#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "firmware/experiments/demand.hpp"

namespace cartwright::firmware {

struct RelaySetup {
  double settle_s = 1;      ///< start-up that is not judged
  double tolerance = 0.02;  ///< cycles agree when amplitude and period spread by less than this part
  int cycles = 4;           ///< in a row that must agree; as many are recorded again after that
  bool stop = true;         ///< end when converged, or when clearly not; else run for the whole duration
  double duration_s = 6;    ///< at the longest
  double start_m = 0;       ///< where the cart stands when the relays take over
  double deadband_m =
      1e-4;  ///< a crossing counts once the cart has passed zero by this: encoder noise makes none
};

/// Dual relay about zero: the reference is zero, the relays in the control law do the rest. Watches for the
/// limit cycle: a cycle runs from one upward crossing to the next and has a period and an amplitude (half its
/// peak to peak). Converged: `cycles` in a row agree within the tolerance; then as many again are recorded
/// for the measurement. Clearly not: no crossing for longer than kStalled_s (the cart sticks or drifts), or
/// kMostCycles without agreement.
class Relay {
 public:
  static constexpr double kStalled_s = 3;
  static constexpr int kMostCycles = 60;

  explicit Relay(const RelaySetup& setup = {}) : setup_(setup) {}

  double start_m() const noexcept { return setup_.start_m; }
  double duration_s() const noexcept { return setup_.duration_s; }
  bool converged() const noexcept { return converged_; }
  double period_s() const noexcept { return count_ > 0 ? period_s_[(count_ - 1) % kKept] : 0; }
  double amplitude_m() const noexcept { return count_ > 0 ? amplitude_m_[(count_ - 1) % kKept] : 0; }

  Demand at(double time_s, double measured_m) noexcept {
    watch(time_s, measured_m);
    if (!setup_.stop) return {};
    if (converged_ && after_ >= setup_.cycles) return {0, 0, wire::Outcome::converged};
    const bool stalled = time_s > setup_.settle_s && time_s - std::max(last_crossing_s_, 0.0) > kStalled_s;
    if (!converged_ && (stalled || judged_ > kMostCycles)) return {0, 0, wire::Outcome::not_converged};
    return {};
  }

  /// How it ended when it ran to its full duration.
  wire::Outcome verdict() const noexcept {
    return converged_ ? wire::Outcome::converged : wire::Outcome::not_converged;
  }

 private:
  static constexpr std::size_t kKept = 50;

  void watch(double time_s, double y) noexcept {
    least_ = std::min(least_, y);
    greatest_ = std::max(greatest_, y);
    if (y < -setup_.deadband_m) below_ = true;
    if (!below_ || y < setup_.deadband_m) return;
    below_ = false;  // an upward crossing
    if (last_crossing_s_ >= 0) complete_cycle(time_s);
    last_crossing_s_ = time_s;
    least_ = greatest_ = y;
  }

  void complete_cycle(double time_s) noexcept {
    period_s_[count_ % kKept] = time_s - last_crossing_s_;
    amplitude_m_[count_ % kKept] = 0.5 * (greatest_ - least_);
    ++count_;
    if (time_s < setup_.settle_s) return;
    ++judged_;
    if (converged_) {
      ++after_;
    } else {
      converged_ = judged_ >= setup_.cycles && agree(period_s_) && agree(amplitude_m_);
    }
  }

  bool agree(const std::array<double, kKept>& values) const noexcept {
    double least = values[(count_ - 1) % kKept], greatest = least;
    for (std::size_t back = 2; back <= static_cast<std::size_t>(setup_.cycles); ++back) {
      const double value = values[(count_ - back) % kKept];
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    return greatest - least <= setup_.tolerance * greatest;
  }

  RelaySetup setup_;
  std::array<double, kKept> period_s_{}, amplitude_m_{};
  std::size_t count_ = 0;
  int judged_ = 0, after_ = 0;
  double last_crossing_s_ = -1, least_ = 0, greatest_ = 0;
  bool below_ = false, converged_ = false;
};

}  // namespace cartwright::firmware
