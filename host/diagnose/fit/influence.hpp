#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "host/diagnose/observe/observer.hpp"

namespace cartwright {

/// How the one-step errors of an observer answer to something the model lacks: the linear recursion of its
/// error state p = (position, velocity, disturbance),
///
///     e(k) = p1 + b(k),   p <- p - K e(k),   p(k+1) = F p + (T^2/2, T, 0) a(k)
///
/// for a missing acceleration a(k) of the cart and a missing part b(k) of the reading. `Value` is a number,
/// or an Eigen array: several recursions abreast.
template <typename Value>
class Influences {
 public:
  /// The gains must outlive it.
  Influences(const ObserverGains& gains, double period_s, double damping_per_s)
      : gains_(&gains), period_s_(period_s), damping_per_s_(damping_per_s) {}

  /// Takes row k: the acceleration that acts from row k - 1 to k, the part of reading k; returns e(k).
  Value step(std::size_t row, const Value& acceleration_m_per_s2, const Value& reading_m) noexcept {
    const double t = period_s_;
    const ObserverGain& g = gains_->at(row);
    const Value mean_acceleration = acceleration_m_per_s2 + d_ - damping_per_s_ * v_;
    y_ += t * v_ + 0.5 * t * t * mean_acceleration;
    v_ += t * mean_acceleration;
    const Value e = y_ + reading_m;
    y_ -= g.position * e;
    v_ -= g.velocity_per_s * e;
    d_ = g.disturbance_decay * d_ - g.disturbance_per_s2 * e;
    return e;
  }

  void reset() { y_ = v_ = d_ = nothing(); }

 private:
  const ObserverGains* gains_;
  double period_s_, damping_per_s_;
  static Value nothing() {
    if constexpr (std::is_arithmetic_v<Value>) {
      return 0;
    } else {
      return Value::Zero();
    }
  }
  Value y_ = nothing(), v_ = nothing(), d_ = nothing();
};

using Influence = Influences<double>;

}  // namespace cartwright
