#pragma once

#include <cstdint>

#include "hal/interface/tick.hpp"

namespace cartwright::hal {

/// How far a value from a device can be believed.
enum class Validity : std::uint8_t {
  valid,
  suspect,  ///< delivered, but the device reports lost edges or a bad transition since the last reading
  invalid,  ///< nothing was delivered: the other fields are those of the last valid reading
};

struct Measurement {
  double position_m = 0;  ///< whole counts times the resolution; positive the way positive voltage drives
  std::int64_t timestamp_ns = 0;  ///< when the cart was there, on the loop's clock
  std::int64_t age_ns = 0;        ///< tick.now_ns - timestamp_ns, never negative
  std::uint32_t sequence =
      0;  ///< counts up by one with every fresh reading; the same number is the same reading
  Validity validity = Validity::invalid;
};

/// An incremental position encoder.
///
/// Contract:
/// - `read` is called once per tick from the loop's thread, returns without waiting, and neither allocates,
/// locks nor
///   throws. A device that has nothing new repeats its last reading with the same sequence number and a
///   greater age.
/// - A reading that failed leaves the fields as the last valid one and says `invalid`.
/// - Positions are continuous: a counter that overflows is unwrapped below this interface.
class Encoder {
 public:
  virtual ~Encoder() = default;
  virtual void read(const Tick& tick, Measurement& measurement) noexcept = 0;
  /// One count, greater than zero.
  virtual double resolution_m() const noexcept = 0;
};

}  // namespace cartwright::hal
