#pragma once

#include <cstdint>

#include "common/identify/weak_windows.hpp"

namespace cartwright {

/// Watches whether recordings go on matching a model. The innovation of a window is what the model leaves of
/// its mean acceleration; its rms runs over the last 400 windows, some ten seconds of movement:
///
///     e_rms > max(2 e_learned, 2 % of the rms of beta u)        after it was learned
///     e_rms > 10 % of the rms of beta u                                at any time
///
/// raises a notice, and 70 % of that takes it back. e_learned is what the model left in the first ten seconds
/// of movement after it was set: encoder, disturbance and all that it never explained. No allocation, no
/// exception.
class ModelMonitor {
 public:
  static constexpr std::uint32_t kWindows = 400;

  /// A model was set, or replaced: learn again.
  void restart() noexcept { *this = ModelMonitor(); }
  void add(const WeakWindow& window) noexcept;

  bool raised() const noexcept { return raised_; }
  bool learned() const noexcept { return learned_m_per_s2_ > 0; }
  double innovation_m_per_s2() const noexcept { return innovation_m_per_s2_; }
  /// What raises the notice now; 0 before there is anything to judge by.
  double limit_m_per_s2() const noexcept { return limit_m_per_s2_; }

 private:
  std::uint32_t windows_ = 0;
  double error_square_ = 0, drive_square_ = 0;
  double learned_m_per_s2_ = 0, innovation_m_per_s2_ = 0, limit_m_per_s2_ = 0;
  bool raised_ = false;
};

}  // namespace cartwright
