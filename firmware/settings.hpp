#pragma once

#include <array>

#include "common/control/pid.hpp"
#include "common/wire/register_map.hpp"

namespace cartwright::firmware {

/// The value of every register that a client may write, starting from the map's initial values. Writers check
/// ranges; what stands here is within them.
class Settings {
 public:
  Settings() {
    for (const wire::Register& r : wire::registers()) values_[static_cast<std::size_t>(r.id)] = r.initial;
  }

  double operator[](wire::Id id) const { return values_[static_cast<std::size_t>(id)]; }
  void set(wire::Id id, double value) { values_[static_cast<std::size_t>(id)] = value; }

  int integer(wire::Id id) const { return static_cast<int>((*this)[id]); }
  bool flag(wire::Id id) const { return (*this)[id] != 0; }

  /// What store_gains writes: PD gains and the integral one.
  PidGains staged_gains() const {
    return {gains_from(wire::Id::staged_kp_V_per_m), (*this)[wire::Id::staged_ki_V_per_m_s]};
  }

  /// PD gains from a register `kp` and the three after it.
  PdGains gains_from(wire::Id kp) const {
    const auto first = static_cast<std::size_t>(kp);
    return {values_[first], values_[first + 1], values_[first + 2], values_[first + 3] != 0};
  }

 private:
  std::array<double, wire::kRegisterCount> values_{};
};

}  // namespace cartwright::firmware
