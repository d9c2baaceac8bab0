#pragma once

#include <string_view>

#include "hal/interface/amplifier.hpp"
#include "hal/interface/digital_inputs.hpp"
#include "hal/interface/encoder.hpp"

namespace cartwright::hal {

struct Truth {
  double position_m = 0;
  double velocity_m_per_s = 0;
};

/// What only a simulated cart can offer. A real rig has none: the pointer to it is null.
///
/// Contract: as for the devices, nothing here waits, allocates, locks or throws. `truth` is the state at the
/// last reading of the encoder. `recording_started` lets effects that belong to one recording begin with it.
class SimulationOnly {
 public:
  virtual ~SimulationOnly() = default;
  virtual Truth truth() const noexcept = 0;
  virtual void recording_started(std::string_view file) noexcept = 0;
};

/// The devices that a controller works with. It does not own them.
struct Devices {
  Encoder* encoder = nullptr;
  Amplifier* amplifier = nullptr;
  DigitalInputs* inputs = nullptr;
  SimulationOnly* simulation = nullptr;  ///< null on a real rig
};

}  // namespace cartwright::hal
