// What a tick leaves behind: the identification while running, the log's row, and what is shown.

#include "firmware/controller.hpp"

namespace cartwright::firmware {
namespace {

void note_estimates(LogRecord& record, const Status& status) noexcept {
  if (status.compensation != CompensationMode::off) record.compensation_V = status.compensation_V;
  if (status.compensation == CompensationMode::adaptive) {
    using E = AdaptiveEstimates;
    record.sliding_m_per_s = status.sliding_m_per_s;
    record.estimate_a_V_s_per_m = status.adaptive[E::a];
    record.estimate_b_V_s2_per_m = status.adaptive[E::b];
    record.estimate_f1_V = status.adaptive[E::f1];
    record.estimate_f2_V_s_per_m = status.adaptive[E::f2];
    record.estimate_f_V = status.adaptive[E::f];
  }
  record.identified_gain_m_per_s2_V = status.identified.gain_m_per_s2_V.value;
  record.identified_viscous_per_s = status.identified.viscous_per_s.value;
  record.identified_coulomb_m_per_s2 = status.identified.coulomb_m_per_s2.value;
  record.innovation_m_per_s2 = status.innovation_m_per_s2;
}

}  // namespace

void Controller::identify(const hal::Tick& tick, const Wanted& wanted, double output_V) noexcept {
  // A late reading belongs to another time than the voltage: such rows are missing, and gaps are known.
  if (recording() && readings_.measurement.timestamp_ns >= tick.now_ns) {
    online_.tick(status_.time_s, readings_.measurement.position_m, output_V, wanted.reference_m,
                 wanted.added_V);
  }
  status_.identified = online_.estimates();
  const ModelMonitor& monitor = online_.monitor();
  const bool judged = monitor.limit_m_per_s2() > 0;
  status_.innovation_m_per_s2 = judged ? monitor.innovation_m_per_s2() : Status::kNothing;
  status_.innovation_limit_m_per_s2 = judged ? monitor.limit_m_per_s2() : Status::kNothing;
  status_.compensation = compensation_.mode();
  status_.compensation_V = recording() && !relay_active_ ? compensation_.voltage_V() : 0;
  status_.sliding_m_per_s = compensation_.adaptive().sliding_m_per_s();
  status_.adaptive = compensation_.adaptive().estimates();
  status_.limits_met = compensation_.limits_met();
}

void Controller::take_notice() noexcept {
  const wire::Notice now = online_.monitor().raised() ? wire::Notice::model_mismatch
                           : status_.limits_met != 0  ? wire::Notice::compensation_limit
                                                      : wire::Notice::none;
  if (now != status_.notice && now != wire::Notice::none) {
    ++status_.notices;
    status_.notice_time_s = status_.time_s;
  }
  status_.notice = now;
}

void Controller::log(const hal::Tick& tick, double lateness_s, std::uint32_t missed, const Wanted& wanted,
                     double output_V) noexcept {
  LogRecord record;
  record.t_s = status_.time_s;
  record.r_m = wanted.reference_m;
  record.y_m = readings_.measurement.position_m;
  record.u_V = output_V;
  record.d_V = wanted.added_V;
  record.i_A = readings_.amplifier.current_A;
  record.bus_V = readings_.amplifier.bus_V;
  record.motor_C = readings_.amplifier.motor_C;
  const std::uint32_t flags =
      static_cast<std::uint32_t>(status_.state) |
      (gains_changed_ && recording() ? wire::kStatusGainsChanged : 0) |
      (readings_.measurement.timestamp_ns < tick.now_ns ? wire::kStatusMeasurementLate : 0) |
      (status_.state == wire::State::running && !recording() ? wire::kStatusApproaching : 0) |
      (status_.notice != wire::Notice::none ? wire::kStatusNotice : 0) |
      (static_cast<std::uint32_t>(status_.fault.fault) << 8U);
  record.status = flags;
  record.limited_by = static_cast<double>(status_.limited_by);
  record.missed_ticks = missed;
  record.lateness_s = lateness_s;
  if (devices_.simulation) {
    const hal::Truth truth = devices_.simulation->truth();
    record.truth_y_m = truth.position_m;
    record.truth_v_m_per_s = truth.velocity_m_per_s;
  }
  note_estimates(record, status_);
  exchange_.log.append(record);
  status_.lost_rows += missed;
  if (recording()) entry_.missed_rows += missed;
}

void Controller::show(const Wanted& wanted, double output_V) noexcept {
  status_.reference_m = wanted.reference_m;
  status_.position_m = readings_.measurement.position_m;
  status_.voltage_V = output_V;
  status_.added_V = wanted.added_V;
  status_.velocity_m_per_s = supervisor_.velocity_m_per_s();
  status_.current_A = readings_.amplifier.current_A;
  status_.bus_V = readings_.amplifier.bus_V;
  status_.motor_C = readings_.amplifier.motor_C;
  status_.inputs = static_cast<std::uint16_t>((readings_.inputs.emergency_stop ? 1U : 0U) |
                                              (readings_.inputs.low_end_stop ? 2U : 0U) |
                                              (readings_.inputs.high_end_stop ? 4U : 0U));
  if (devices_.simulation) {
    const hal::Truth truth = devices_.simulation->truth();
    status_.truth_position_m = truth.position_m;
    status_.truth_velocity_m_per_s = truth.velocity_m_per_s;
  }
  exchange_.status.write(status_);
}

}  // namespace cartwright::firmware
