#include "common/control/adaptive_friction.hpp"

#include <algorithm>
#include <numbers>

namespace cartwright {

using E = AdaptiveEstimates;

namespace {

/// A limit touched in passing, as at a start from a poor model, says little.
constexpr double kMet_s = 0.5;

}  // namespace

AdaptiveFriction::AdaptiveFriction(const AdaptiveSettings& settings, double period_s)
    : settings_(settings),
      period_s_(period_s),
      smoothing_(1 - std::exp(-2 * std::numbers::pi * settings.speed_filter_hz * period_s)),
      estimates_(settings.initial) {}

void AdaptiveFriction::set_feedback(const PdGains& gains) noexcept {
  feedback_V_s_per_m_ = settings_.own_feedback || !(settings_.lambda2_per_s > 0)
                            ? 0
                            : gains.kd_V_s_per_m + gains.kp_V_per_m / settings_.lambda2_per_s;
}

void AdaptiveFriction::restart() noexcept {
  first_ = true;
  filtered_ = {};
  integral_m_s_ = error_speed_m_per_s_ = speed_m_per_s_ = sliding_m_per_s_ = 0;
}

double AdaptiveFriction::update(const ReferenceMotion& reference, double reference_m, double measured_m,
                                bool limited) noexcept {
  const double error = reference_m - measured_m;
  if (first_) {
    error_m_ = filtered_error_m_ = error;
    measured_m_ = measured_m;
    first_ = false;
  }
  error_speed_m_per_s_ += smoothing_ * ((error - error_m_) / period_s_ - error_speed_m_per_s_);
  speed_m_per_s_ += smoothing_ * ((measured_m - measured_m_) / period_s_ - speed_m_per_s_);
  error_m_ = error;
  filtered_error_m_ += smoothing_ * (error - filtered_error_m_);
  measured_m_ = measured_m;
  if (!limited) integral_m_s_ += error * period_s_;

  const double l1 = settings_.lambda1_per_s2, l2 = settings_.lambda2_per_s;
  const double zone = settings_.dead_zone_m_per_s;
  sliding_m_per_s_ = l1 * integral_m_s_ + l2 * filtered_error_m_ + error_speed_m_per_s_;
  const double outside = sliding_m_per_s_ - std::clamp(sliding_m_per_s_, -zone, zone);
  const double side = zone > 0 ? std::clamp(outside / zone, -1.0, 1.0) : sign_of(outside);

  const bool measured = settings_.measured_velocity;
  const double velocity = measured ? speed_m_per_s_ : reference.velocity_m_per_s;
  const double direction = measured ? sign_of(velocity) : mean_direction(reference, period_s_);
  const double growing = settings_.printed_f2 ? std::abs(velocity) : velocity;
  double u_c = -reference.acceleration_m_per_s2;
  if (settings_.own_feedback) u_c -= l1 * error + l2 * error_speed_m_per_s_ + settings_.kv_per_s * outside;
  const double voltage_V = -estimates_[E::a] * velocity - estimates_[E::b] * u_c +
                           estimates_[E::f1] * direction + estimates_[E::f2] * growing +
                           estimates_[E::f] * side;
  filtered_.velocity += smoothing_ * (velocity - filtered_.velocity);
  filtered_.direction += smoothing_ * (direction - filtered_.direction);
  filtered_.f2 += smoothing_ * (growing - filtered_.f2);
  filtered_.u_c += smoothing_ * (u_c - filtered_.u_c);
  if (!limited) adapt(outside);
  return voltage_V;
}

double AdaptiveFriction::initial_V(const ReferenceMotion& reference) const noexcept {
  const AdaptiveEstimates& from = settings_.initial;
  return (from[E::f2] - from[E::a]) * reference.velocity_m_per_s +
         from[E::b] * reference.acceleration_m_per_s2 + from[E::f1] * mean_direction(reference, period_s_);
}

void AdaptiveFriction::adapt(double outside) noexcept {
  const Regressors& by = filtered_;
  const std::array<double, E::kCount> phi{-by.velocity, -by.u_c, by.direction, by.f2, 0};
  double speed = 0;
  for (std::size_t i = 0; i < E::kCount; ++i) speed += settings_.rate.value[i] * phi[i] * phi[i];
  const double most = settings_.fastest_per_s * feedback_V_s_per_m_;
  const double step_s = most > 0 ? period_s_ / (1 + speed / most) : period_s_;
  for (std::size_t i = 0; i < E::kCount; ++i) {
    const double change = i == E::f ? period_s_ * (settings_.rate[E::f] * std::abs(outside) -
                                                   settings_.leakage_per_s * estimates_[E::f])
                                    : step_s * settings_.rate.value[i] * phi[i] * outside;
    const double free = estimates_.value[i] + change;
    const double held = std::clamp(free, settings_.least.value[i], settings_.greatest.value[i]);
    // Where an estimate is not meant to move at all, standing at its limit says nothing.
    if (settings_.rate.value[i] > 0 && outside != 0) {
      held_s_[i] = held != free ? held_s_[i] + period_s_ : 0;
      if (held_s_[i] >= kMet_s) limits_met_ = static_cast<std::uint16_t>(limits_met_ | (1U << i));
    }
    estimates_.value[i] = held;
  }
}

}  // namespace cartwright
