#include "common/identify/weak_windows.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

/// Mean of sgn v from a row to the next, the velocity running straight between them.
double direction(double v0, double v1) noexcept {
  if (v0 * v1 < 0) {
    return std::copysign((std::abs(v0) - std::abs(v1)) / (std::abs(v0) + std::abs(v1)), v0);
  }
  return sign_of(v0 + v1);
}

}  // namespace

double WeakWindows::bump(double start_s, double t_s) const noexcept {
  const double s = std::clamp(2 * (t_s - start_s) / window_s_ - 1, -1.0, 1.0), q = 1 - s * s;
  return q * q * q;
}

WeakWindows::Interval WeakWindows::interval_to(const MovingRow& row, const PlantTerms& terms) const noexcept {
  const OnlineRow &from = before_.row, &to = row.row;
  const double dt = to.t_s - from.t_s, slope = (to.y_m - from.y_m) / dt;
  const double sign = direction(before_.v_m_per_s, row.v_m_per_s);
  Interval out{from.t_s,
               to.t_s,
               slope,
               0,
               0,
               {from.u_V, -slope, -sign},
               {},
               from.twin && to.twin,
               from.left_out || to.left_out};
  out.z = out.x;
  if (out.twin) {
    out.z = {from.twin_u_V, -(to.twin_y_m - from.twin_y_m) / dt,
             -direction(from.twin_v_m_per_s, to.twin_v_m_per_s)};
  }
  const double y = 0.5 * (from.y_m + to.y_m);
  out.drive_m_per_s2 = terms.beta * terms.amplifier(from.u_V);
  out.modelled_m_per_s2 =
      out.drive_m_per_s2 - terms.damping(slope) - sign * terms.level(y, slope) + terms.pushes(y, 0);
  return out;
}

void WeakWindows::add(Sum& sum, const Interval& interval) const noexcept {
  const double p0 = bump(sum.start_s, interval.from_s), p1 = bump(sum.start_s, interval.to_s);
  const double weight = 0.5 * (p0 + p1) * (interval.to_s - interval.from_s);
  sum.sums.response_m_per_s2 -= interval.slope_m_per_s * (p1 - p0);
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    sum.sums.x[i] += weight * interval.x[i];
    sum.sums.z[i] += weight * interval.z[i];
  }
  sum.sums.modelled_m_per_s2 += weight * interval.modelled_m_per_s2;
  sum.sums.drive_m_per_s2 += weight * interval.drive_m_per_s2;
  sum.twin = sum.twin && interval.twin;
  sum.sums.without_instrument = sum.sums.without_instrument || interval.left_out;
}

void WeakWindows::finish(Sum& sum) noexcept {
  const double area_s = 0.5 * window_s_ * 32.0 / 35.0;
  WeakWindow& out = complete_[completed_++];
  out = sum.sums;
  out.response_m_per_s2 /= area_s;
  out.modelled_m_per_s2 /= area_s;
  out.drive_m_per_s2 /= area_s;
  for (std::size_t i = 0; i < kOnlineUnknowns; ++i) {
    out.x[i] /= area_s;
    out.z[i] /= area_s;
  }
  if (!sum.twin) out.z = out.x;
  sum = {sum.start_s + window_s_, {}, true};
}

std::size_t WeakWindows::push(const MovingRow& row, const PlantTerms& terms) noexcept {
  completed_ = 0;
  if (!row.moving) {
    running_ = false;
    return 0;
  }
  const bool turned = before_.v_m_per_s * row.v_m_per_s <= 0;
  if (!running_ || row.gap || turned) {
    running_ = true;
    before_ = row;
    for (std::size_t i = 0; i < kOverlap; ++i) {
      open_[i] = {row.row.t_s + window_s_ * static_cast<double>(i) / kOverlap, {}, true};
    }
    return 0;
  }
  const Interval interval = interval_to(row, terms);
  for (Sum& sum : open_) {
    if (interval.to_s <= sum.start_s) continue;
    add(sum, interval);
    if (interval.to_s < sum.start_s + window_s_) continue;
    finish(sum);
    if (interval.to_s > sum.start_s) add(sum, interval);
  }
  before_ = row;
  return completed_;
}

}  // namespace cartwright
