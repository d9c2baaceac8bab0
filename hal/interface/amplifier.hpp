#pragma once

#include <cstdint>
#include <limits>

#include "hal/interface/tick.hpp"

namespace cartwright::hal {

struct Command {
  double voltage_V = 0;
  bool enabled = false;  ///< false: the amplifier lets go, whatever the voltage says
};

enum class AmplifierHealth : std::uint8_t {
  good,
  fault,   ///< it answers and reports a fault of its own
  silent,  ///< it does not answer
};

/// What the amplifier said last; NaN where it does not measure.
struct AmplifierReport {
  AmplifierHealth health = AmplifierHealth::silent;
  double current_A = std::numeric_limits<double>::quiet_NaN();
  double bus_V = std::numeric_limits<double>::quiet_NaN();
  double motor_C = std::numeric_limits<double>::quiet_NaN();
};

/// A voltage (or current, or force) amplifier.
///
/// Contract:
/// - `report` then `write` are called once per tick from the loop's thread; both return without waiting and
/// neither
///   allocates, locks nor throws.
/// - A written voltage is held until the next write. Voltages are finite and within the rig's limit: the
/// caller has
///   seen to it. What the amplifier itself cannot deliver it clips.
/// - After a write with `enabled` false no force is left on the cart, at the latest when the next command
/// would have
///   acted. Before the first write the amplifier is off.
class Amplifier {
 public:
  virtual ~Amplifier() = default;
  virtual void report(const Tick& tick, AmplifierReport& report) noexcept = 0;
  virtual void write(const Tick& tick, const Command& command) noexcept = 0;
};

}  // namespace cartwright::hal
