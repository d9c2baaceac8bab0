#include "common/control/compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cartwright {
namespace {

using E = AdaptiveEstimates;

/// Slow against the loop, fast against an experiment.
constexpr double kBump_s = 0.2;
/// Until then what the change left of the error has gone.
constexpr double kSettle_s = 1;
/// Of the sliding surface, where the model has next to no damping.
constexpr double kLeastSlope_per_s = 1;
/// Friction to reckon with where the model knows of none, as a share of the voltage limit.
constexpr double kLeastFriction = 0.02;

}  // namespace

AdaptiveSettings adaptive_about(const Model& model, AdaptiveSettings s, double range,
                                double voltage_limit_V) {
  const double beta = model[Parameter::voltage_gain];
  if (!(beta > 0)) return s;
  const auto in_volts = [&](Term term, Parameter parameter) {
    return model.has(term) ? model[parameter] / beta : 0.0;
  };
  const double a = -in_volts(Term::viscous_friction, Parameter::viscous_coefficient);
  const double f1 = in_volts(Term::coulomb_friction, Parameter::coulomb_level);
  if (s.lambda2_per_s == 0) s.lambda2_per_s = std::max(kLeastSlope_per_s, -a * beta);
  const double scale_V = std::max(f1, kLeastFriction * voltage_limit_V);
  s.initial.value = {a, 1 / beta, f1, 0, 0};
  s.least.value = {(1 + range) * a, 1 / beta / (1 + range), 0, range * a, 0};
  s.greatest.value = {0, (1 + range) / beta, f1 + range * scale_V, -range * a, range * scale_V};
  return s;
}

double quiet_dead_zone_m_per_s(const AdaptiveSettings& s, double step_m, double period_s) {
  const double smoothing = 1 - std::exp(-2 * std::numbers::pi * s.speed_filter_hz * period_s);
  return 0.5 * step_m * (s.lambda2_per_s + smoothing / period_s);
}

Compensation::Prepared Compensation::prepare(const CompensationSettings& settings, double period_s) {
  Prepared out;
  out.mode = settings.mode;
  out.limit_V = settings.limit_V;
  out.feed_forward = FeedForward(settings.model, period_s);
  out.adaptive = AdaptiveFriction(settings.adaptive, period_s);
  return out;
}

Compensation::Compensation(double period_s)
    : settle_ticks_(static_cast<int>(std::lround(kSettle_s / period_s))),
      bump_decay_(std::exp(-period_s / kBump_s)) {}

void Compensation::set(const Prepared& prepared) noexcept {
  next_ = prepared;
  next_.adaptive.set_feedback(feedback_);
  pending_ = true;
}

void Compensation::set_feedback(const PdGains& feedback) noexcept {
  feedback_ = feedback;
  active_.adaptive.set_feedback(feedback);
  next_.adaptive.set_feedback(feedback);
}

void Compensation::restart(const PdGains& feedback) noexcept {
  set_feedback(feedback);
  active_.adaptive.restart();
  next_.adaptive.restart();
  if (pending_) {
    active_ = next_;
    pending_ = whole_limited_ = false;
  }
  bump_V_ = 0;
  settling_ = 0;
}

double Compensation::wanted_V(Prepared& law, const ReferenceMotion& reference, double reference_m,
                              double measured_m, bool limited) noexcept {
  switch (law.mode) {
    case CompensationMode::feed_forward:
      return law.feed_forward.voltage_V(reference);
    case CompensationMode::adaptive: {
      const double learned_V = law.adaptive.update(reference, reference_m, measured_m, limited);
      if (!law.feed_forward.has_model()) return learned_V;
      // What the model says beyond the terms that adapt stays as it is.
      const double beyond_V = law.feed_forward.drive_V(reference) - law.adaptive.initial_V(reference);
      return law.feed_forward.through_amplifier_V(beyond_V + learned_V);
    }
    default:
      return 0;
  }
}

double Compensation::update(const ReferenceMotion& reference, double reference_m, double measured_m,
                            bool limited) noexcept {
  if (pending_) {
    const double before_V = wanted_V(active_, reference, reference_m, measured_m, limited) + bump_V_;
    Prepared trial = next_;
    bump_V_ = before_V - wanted_V(trial, reference, reference_m, measured_m, limited);
    active_ = next_;
    pending_ = whole_limited_ = false;
    settling_ = settle_ticks_;
  }
  const bool learns = !limited && settling_ == 0;
  if (settling_ > 0) --settling_;
  const double free_V = wanted_V(active_, reference, reference_m, measured_m, !learns) + bump_V_;
  bump_V_ *= bump_decay_;
  voltage_V_ = std::clamp(free_V, -active_.limit_V, active_.limit_V);
  whole_limited_ = whole_limited_ || voltage_V_ != free_V;
  return voltage_V_;
}

std::uint16_t Compensation::limits_met() const noexcept {
  return static_cast<std::uint16_t>(active_.adaptive.limits_met() | (whole_limited_ ? 1U << E::kCount : 0U));
}

}  // namespace cartwright
