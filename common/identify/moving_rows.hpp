#pragma once

#include <array>
#include <cstddef>

namespace cartwright {

/// One tick of a running rig: the reading at `t_s`, and the voltage held from then to the next tick. With a
/// twin (the noise-free closed loop of a model) also what that does.
struct OnlineRow {
  double t_s = 0, y_m = 0, u_V = 0;
  bool twin = false;
  double twin_y_m = 0, twin_v_m_per_s = 0, twin_u_V = 0;
  bool left_out = false;  ///< there is a twin, and it is out of step: one more row like that would be biased
};

/// A row as it is known a little later.
struct MovingRow {
  OnlineRow row;
  double v_m_per_s = 0;
  bool moving = false;  ///< else the cart sticks, and friction equals whatever acts
  bool gap = false;     ///< rows are missing between the one before and this one
};

struct MovingRowsSetup {
  double period_s = 1e-3;
  double step_m = 2.275e-5;   ///< of the encoder
  double smoothing_s = 8e-3;  ///< half width of the straight line that gives the velocity
  double stuck_s = 12e-3;     ///< half width of the stretch that must show movement
  double stuck_counts = 2.2;  ///< less movement than this within that stretch counts as standing still
};

/// Velocity and movement of every row, `stuck_s` after it came in: the offline `motion_of` (host/identify) as
/// a stream, with a straight line instead of a parabola (the same slope in the middle of an even stretch).
/// No allocation, no exception.
class MovingRows {
 public:
  explicit MovingRows(const MovingRowsSetup& setup);

  /// The rows to come do not follow those before.
  void interrupt() noexcept;

  /// Takes the newest row. True where one became known: `known()`.
  bool push(const OnlineRow& row) noexcept;
  const MovingRow& known() const noexcept { return known_; }

 private:
  static constexpr std::size_t kCapacity = 128;
  const OnlineRow& back(std::size_t age) const noexcept {
    return rows_[(next_ + kCapacity - 1 - age) % kCapacity];
  }

  MovingRowsSetup setup_;
  std::size_t half_, smooth_;
  std::array<OnlineRow, kCapacity> rows_{};
  std::size_t next_ = 0, count_ = 0;
  bool first_known_ = true;
  MovingRow known_;
};

}  // namespace cartwright
