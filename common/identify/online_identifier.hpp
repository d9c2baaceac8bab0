#pragma once

#include <cstdint>
#include <limits>

#include "common/identify/weak_windows.hpp"

namespace cartwright {

/// A number with its 95 % interval; NaN while the data gives none.
struct OnlineEstimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

struct OnlineEstimates {
  OnlineEstimate gain_m_per_s2_V, viscous_per_s, coulomb_m_per_s2;
  std::uint32_t windows = 0;  ///< equations behind them
};

/// The integral method while the rig runs: voltage gain, viscous damping and Coulomb friction of
///
///     y'' = beta u - c v - f sgn v
///
/// from the windows of weak_windows.hpp, by Z' X theta = Z' r with the twin as instrument (which knows
/// nothing of what the controller fed back into u). Forty windows, a second of movement, make a block; the
/// newest 128 blocks count, and older ones are taken out again: memory is two minutes of movement, and
/// neither time nor storage grow. Intervals come from what the blocks leave, g_b = Z_b'(r_b - X_b theta):
///
///     cov theta = (Z'X)^-1 sum g_b g_b' (X'Z)^-1,
///
/// with Student's t for their number: overlapping windows and coloured disturbance do not make them narrow.
/// The work after a block is spread over the ticks that follow. No allocation, no exception.
class OnlineIdentifier {
 public:
  static constexpr std::size_t kBlocks = 128, kFewestBlocks = 6, kWindowsPerBlock = 40;

  void restart() noexcept;
  /// Starts its sums anew; the estimates stay until there are others.
  void forget_blocks() noexcept;
  void add(const WeakWindow& window) noexcept;
  /// Once per tick: goes on with what a finished block asks for. True when new estimates are there.
  bool refine() noexcept;

  const OnlineEstimates& estimates() const noexcept { return estimates_; }
  std::size_t blocks() const noexcept { return count_; }

 private:
  using Matrix = std::array<OnlineVector, kOnlineUnknowns>;
  struct Block {
    Matrix zx{};
    OnlineVector zr{};
    std::uint32_t windows = 0;
  };

  void close_block() noexcept;
  void conclude() noexcept;

  Block open_, sum_;
  std::array<Block, kBlocks> blocks_{};
  std::size_t next_ = 0, count_ = 0;
  // What is under way: theta of the last sum, its inverse, and the blocks' scatter so far.
  OnlineVector theta_{};
  Matrix inverse_{}, scatter_{};
  std::size_t cursor_ = 0;
  bool refining_ = false;
  OnlineEstimates estimates_;
};

}  // namespace cartwright
