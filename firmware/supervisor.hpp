#pragma once

#include <cstdint>

#include "common/wire/codes.hpp"
#include "hal/interface/stage.hpp"

namespace cartwright::firmware {

/// The bounds that the supervisor holds the rig to.
struct Bounds {
  double travel_low_m = -0.4, travel_high_m = 0.4;  ///< margin already taken off
  double resolution_m = 2.275e-5;
  double greatest_speed_m_per_s = 5;
  double stuck_V = 3, stuck_s = 0.25;
  double oldest_s = 0.005;
  double host_timeout_s = 2;
  std::uint32_t most_missed_ticks = 20;
};

/// What a fault was about: a number, and the bound it broke. Both zero where there is none.
struct FaultReport {
  wire::Fault fault = wire::Fault::none;
  double value = 0, bound = 0;
};

/// Everything that was read at one tick.
struct Readings {
  hal::Inputs inputs;
  hal::Measurement measurement;
  hal::AmplifierReport amplifier;
};

/// Looks at every tick for a reason to take the voltage away. Remembers what it needs from tick to tick,
/// decides nothing else: the controller keeps the state. No allocation, no exception.
class Supervisor {
 public:
  explicit Supervisor(const Bounds& bounds) : bounds_(bounds) {}

  /// Conditions that hold whatever the output is. Call once per tick.
  FaultReport watch(const Readings& now, double period_s, double last_output_V,
                    std::uint32_t missed_ticks) noexcept;

  /// Conditions on the voltage about to be put out: end stops and travel stop only what would go further out,
  /// so that a cart that overshot can be driven back.
  FaultReport judge(const Readings& now, double output_V, bool finite) const noexcept;

  /// Low-passed speed from successive readings [m/s].
  double velocity_m_per_s() const noexcept { return velocity_m_per_s_; }

  /// Forgets the past: after a reset the next reading is the first.
  void restart() noexcept;

 private:
  FaultReport watch_encoder(const hal::Measurement& m, double period_s, double last_output_V) noexcept;

  Bounds bounds_;
  bool first_ = true;
  double last_m_ = 0, velocity_m_per_s_ = 0, still_s_ = 0;
  std::int64_t last_ns_ = 0;
  std::uint32_t last_sequence_ = 0;
};

}  // namespace cartwright::firmware
