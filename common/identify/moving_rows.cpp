#include "common/identify/moving_rows.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

std::size_t rows_in(double time_s, double period_s, std::size_t least, std::size_t most) {
  return std::clamp(static_cast<std::size_t>(std::max(0.0, std::round(time_s / period_s))), least, most);
}

}  // namespace

MovingRows::MovingRows(const MovingRowsSetup& setup)
    : setup_(setup),
      half_(rows_in(setup.stuck_s, setup.period_s, 3, kCapacity / 2 - 1)),
      smooth_(rows_in(setup.smoothing_s, setup.period_s, 3, half_)) {}

void MovingRows::interrupt() noexcept {
  count_ = 0;
  first_known_ = true;
}

bool MovingRows::push(const OnlineRow& row) noexcept {
  // A tick that came late is no gap; half a period more than the nominal one is.
  if (count_ > 0 && !(row.t_s - back(0).t_s < 1.5 * setup_.period_s)) interrupt();
  rows_[next_] = row;
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
  if (count_ < 2 * half_ + 1) return false;

  const OnlineRow& middle = back(half_);
  double least = middle.y_m, most = middle.y_m;
  for (std::size_t age = 0; age <= 2 * half_; ++age) {
    least = std::min(least, back(age).y_m);
    most = std::max(most, back(age).y_m);
  }
  double tt = 0, ty = 0, t = 0, y = 0;
  for (std::size_t age = half_ - smooth_; age <= half_ + smooth_; ++age) {
    const double dt = back(age).t_s - middle.t_s, dy = back(age).y_m - middle.y_m;
    t += dt;
    y += dy;
    tt += dt * dt;
    ty += dt * dy;
  }
  const auto n = static_cast<double>(2 * smooth_ + 1);
  known_.row = middle;
  known_.v_m_per_s = (n * ty - t * y) / (n * tt - t * t);
  known_.moving = most - least > setup_.stuck_counts * setup_.step_m;
  known_.gap = first_known_;
  first_known_ = false;
  return true;
}

}  // namespace cartwright
