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

void AdaptiveFriction::restart() noexcept {
  first_ = true;
  integral_m_s_ = error_speed_m_per_s_ = speed_m_per_s_ = sliding_m_per_s_ = 0;
}

double AdaptiveFriction::update(const ReferenceMotion& reference, double reference_m, double measured_m,
                                bool limited) noexcept {
  const double error = reference_m - measured_m;
  if (first_) {
    error_m_ = error;
    measured_m_ = measured_m;
    first_ = false;
  }
  error_speed_m_per_s_ += smoothing_ * ((error - error_m_) / period_s_ - error_speed_m_per_s_);
  speed_m_per_s_ += smoothing_ * ((measured_m - measured_m_) / period_s_ - speed_m_per_s_);
  error_m_ = error;
  measured_m_ = measured_m;
  if (!limited) integral_m_s_ += error * period_s_;

  const double l1 = settings_.lambda1_per_s2, l2 = settings_.lambda2_per_s;
  const double zone = settings_.dead_zone_m_per_s;
  sliding_m_per_s_ = l1 * integral_m_s_ + l2 * error + error_speed_m_per_s_;
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
  if (!limited) adapt({velocity, direction, growing, u_c}, outside);
  return voltage_V;
}

double AdaptiveFriction::initial_V(const ReferenceMotion& reference) const noexcept {
  const AdaptiveEstimates& from = settings_.initial;
  return (from[E::f2] - from[E::a]) * reference.velocity_m_per_s +
         from[E::b] * reference.acceleration_m_per_s2 + from[E::f1] * mean_direction(reference, period_s_);
}

void AdaptiveFriction::adapt(const Regressors& by, double outside) noexcept {
  const std::array<double, E::kCount> slope{
      -settings_.rate[E::a] * by.velocity * outside, -settings_.rate[E::b] * by.u_c * outside,
      settings_.rate[E::f1] * by.direction * outside, settings_.rate[E::f2] * by.f2 * outside,
      settings_.rate[E::f] * std::abs(outside) - settings_.leakage_per_s * estimates_[E::f]};
  for (std::size_t i = 0; i < E::kCount; ++i) {
    const double free = estimates_.value[i] + period_s_ * slope[i];
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
