#pragma once

#include "hal/interface/encoder.hpp"
#include "hal/interface/tick.hpp"

namespace cartwright::hal {

/// True is always the unsafe side: a broken wire reads as pressed.
struct Inputs {
  bool emergency_stop = true;
  bool low_end_stop = true;
  bool high_end_stop = true;
  Validity validity = Validity::invalid;
};

/// The emergency stop and the two end stops.
///
/// Contract: `read` is called once per tick from the loop's thread, returns without waiting, and neither
/// allocates, locks nor throws. Inputs that cannot be read are reported as pressed and `invalid`.
class DigitalInputs {
 public:
  virtual ~DigitalInputs() = default;
  virtual void read(const Tick& tick, Inputs& inputs) noexcept = 0;
};

}  // namespace cartwright::hal
