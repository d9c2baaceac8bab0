#pragma once

#include <cstdint>
#include <limits>

namespace cartwright::hal::sim {

inline constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

/// What goes wrong with the simulated rig, and when, on the loop's clock. Each begins at its time and stays.
struct Faults {
  std::int64_t encoder_stuck_ns = kNever_ns;  ///< repeats the reading it had, as fresh ones
  std::int64_t encoder_dead_ns = kNever_ns;   ///< delivers nothing
  std::int64_t encoder_jump_ns = kNever_ns;   ///< readings are off by `jump_m` from here on
  double jump_m = 0.05;
  std::int64_t encoder_late_ns = kNever_ns;     ///< readings are `latency_ns` old from here on
  std::int64_t latency_ns = 0;                  ///< at most 64 readings back
  std::int64_t amplifier_dead_ns = kNever_ns;   ///< silent; drives nothing
  std::int64_t amplifier_fault_ns = kNever_ns;  ///< reports a fault; drives nothing
  std::int64_t command_late_ns = kNever_ns;     ///< commands act one write later from here on
  std::int64_t emergency_stop_ns = kNever_ns;   ///< pressed; cuts the drive as the wiring of a real one does
};

}  // namespace cartwright::hal::sim
