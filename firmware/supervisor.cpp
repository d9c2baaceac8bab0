#include "firmware/supervisor.hpp"

#include <cmath>

namespace cartwright::firmware {
namespace {

using wire::Fault;

/// Time constant of the speed estimate: long against the encoder's rounding (one count per tick at 1 kHz and
/// 23 um would read 23 mm/s), short against a stroke.
constexpr double kVelocityFilter_s = 0.01;
/// Slower than this towards an end is standing still: rounding alone stays below it.
constexpr double kMoving_m_per_s = 0.02;

}  // namespace

void Supervisor::restart() noexcept {
  first_ = true;
  velocity_m_per_s_ = 0;
  still_s_ = 0;
}

FaultReport Supervisor::watch(const Readings& now, double period_s, double last_output_V,
                              std::uint32_t missed_ticks) noexcept {
  if (now.inputs.emergency_stop) return {Fault::emergency_stop};
  const FaultReport encoder = watch_encoder(now.measurement, period_s, last_output_V);
  if (encoder.fault != Fault::none) return encoder;
  if (now.amplifier.health == hal::AmplifierHealth::silent) return {Fault::amplifier_dead};
  if (now.amplifier.health == hal::AmplifierHealth::fault) return {Fault::amplifier_fault};
  if (missed_ticks > bounds_.most_missed_ticks) {
    return {Fault::missed_ticks, static_cast<double>(missed_ticks),
            static_cast<double>(bounds_.most_missed_ticks)};
  }
  return {};
}

FaultReport Supervisor::watch_encoder(const hal::Measurement& m, double period_s,
                                      double last_output_V) noexcept {
  if (m.validity == hal::Validity::invalid || !std::isfinite(m.position_m)) return {Fault::encoder_dead};
  const double age_s = static_cast<double>(m.age_ns) * 1e-9;
  if (age_s > bounds_.oldest_s) return {Fault::encoder_late, age_s, bounds_.oldest_s};
  if (first_) {
    first_ = false;
    last_m_ = m.position_m;
    last_ns_ = m.timestamp_ns;
    last_sequence_ = m.sequence;
    return {};
  }
  if (m.sequence == last_sequence_) return {};
  const double elapsed_s = static_cast<double>(m.timestamp_ns - last_ns_) * 1e-9;
  const double moved_m = m.position_m - last_m_;
  last_m_ = m.position_m;
  last_ns_ = m.timestamp_ns;
  last_sequence_ = m.sequence;
  if (elapsed_s <= 0) return {};
  const double speed = std::abs(moved_m) / elapsed_s;
  // Rounding alone may move a reading by one count; two are allowed.
  if (std::abs(moved_m) > 2 * bounds_.resolution_m && speed > bounds_.greatest_speed_m_per_s) {
    return {Fault::encoder_jump, speed, bounds_.greatest_speed_m_per_s};
  }
  velocity_m_per_s_ +=
      elapsed_s / (kVelocityFilter_s + elapsed_s) * (moved_m / elapsed_s - velocity_m_per_s_);
  const bool pushed = std::abs(last_output_V) > bounds_.stuck_V;
  still_s_ = pushed && moved_m == 0 ? still_s_ + period_s : 0;
  if (still_s_ > bounds_.stuck_s) return {Fault::encoder_stuck, last_output_V, still_s_};
  return {};
}

FaultReport Supervisor::judge(const Readings& now, double output_V, bool finite) const noexcept {
  if (!finite) return {Fault::command_not_finite};
  const double position_m = now.measurement.position_m;
  const bool downwards = output_V < 0 || velocity_m_per_s_ < -kMoving_m_per_s;
  const bool upwards = output_V > 0 || velocity_m_per_s_ > kMoving_m_per_s;
  if ((now.inputs.low_end_stop && downwards) || (now.inputs.high_end_stop && upwards)) {
    return {Fault::end_stop, position_m};
  }
  if (now.inputs.validity == hal::Validity::invalid) return {Fault::end_stop, position_m};
  if (position_m < bounds_.travel_low_m && downwards)
    return {Fault::travel_limit, position_m, bounds_.travel_low_m};
  if (position_m > bounds_.travel_high_m && upwards)
    return {Fault::travel_limit, position_m, bounds_.travel_high_m};
  return {};
}

}  // namespace cartwright::firmware
