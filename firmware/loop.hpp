#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/controller.hpp"
#include "firmware/exchange/histogram.hpp"
#include "firmware/pacer.hpp"

namespace cartwright::firmware {

/// What the loop measures of itself, for other threads to read.
struct Telemetry {
  Histogram lateness, step_time;
};

/// The fixed-rate loop: one deadline per period, absolute, on whatever clock the pacer keeps. Ticks that
/// could not be kept are counted and handed to the controller, and the deadlines go on in their grid.
class Loop {
 public:
  Loop(Controller& controller, Pacer& pacer, std::int64_t period_ns, Telemetry& telemetry);

  /// Runs until told to stop.
  void run(const std::atomic<bool>& stop) noexcept {
    while (!stop.load(std::memory_order_relaxed)) tick();
  }

  void tick() noexcept;

 private:
  Controller& controller_;
  Pacer& pacer_;
  Telemetry& telemetry_;
  std::int64_t period_ns_, deadline_ns_, last_ns_;
};

}  // namespace cartwright::firmware
