#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/control/pid.hpp"
#include "common/result.hpp"

namespace cartwright::firmware {

struct GainSlot {
  std::uint32_t generation = 0;  ///< counts up with every store; the greatest is the newest
  PidGains gains;
};

/// Two slots of gains in one small text file, each with a CRC-32 of its own. A store goes into the slot that
/// is not active and the file is replaced as a whole: whatever happens half way, the old gains are still
/// there. A slot whose checksum or bounds are wrong does not count. At start the newest valid slot is active.
class GainStore {
 public:
  /// A file that is not there is an empty store.
  static Result<GainStore> open(const std::filesystem::path& file);

  const std::optional<GainSlot>& slot(int number) const {
    return slots_[static_cast<std::size_t>(number - 1)];
  }
  /// A sentence for every line of the file that was not believed.
  const std::vector<std::string>& doubts() const { return doubts_; }
  /// 1 or 2; 0 while neither slot is valid.
  int active() const { return active_; }

  /// Writes gains into the other slot and makes it active. Gains out of bounds or a full disk: nothing
  /// changes.
  Result<void> store(const PidGains& gains);
  /// Makes another valid slot the active one, until the next start.
  Result<void> activate(int number);

 private:
  std::filesystem::path file_;
  std::array<std::optional<GainSlot>, 2> slots_;
  std::vector<std::string> doubts_;
  int active_ = 0;
};

/// Whether gains lie in the ranges of the registers they are staged in.
bool within_bounds(const PidGains& gains);

}  // namespace cartwright::firmware
