// What each register of the map shows: the reading half of RegisterFile.

#include <fmt/format.h>

#include <algorithm>

#include "common/wire/codec.hpp"
#include "firmware/register_file.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;

template <typename Code>
double code(Code value) {
  return static_cast<double>(value);
}

bool between(Id id, Id first, Id last) {
  return id >= first && id <= last;
}

double gain(const PidGains& all, std::size_t place) {
  const PdGains& gains = all.pd;
  switch (place) {
    case 0:
      return gains.kp_V_per_m;
    case 1:
      return gains.kd_V_s_per_m;
    case 2:
      return gains.derivative_filter_hz;
    case 3:
      return gains.derivative_on_measurement ? 1 : 0;
    default:
      return all.ki_V_per_m_s;
  }
}

std::size_t place(Id id, Id first) {
  return static_cast<std::size_t>(id) - static_cast<std::size_t>(first);
}

}  // namespace

double RegisterFile::number(Id id, const Client& client, const Status& s,
                            const RecordingEntry& recording) const {
  const bool pending = !exchange_.requests.empty();
  switch (id) {
    case Id::map_version:
      return wire::kMapVersion;
    case Id::simulated:
      return rig_.kind == "simulated" ? 1 : 0;
    case Id::rate_hz:
      return rig_.rig.sample_rate_hz;
    case Id::encoder_resolution_m:
      return rig_.rig.encoder_resolution_m;
    case Id::virtual_time:
      return rig_.virtual_time ? 1 : 0;
    case Id::voltage_limit_V:
      return rig_.rig.voltage_limit_V;
    case Id::slew_limit_V_per_s:
      return rig_.slew_limit_V_per_s;
    case Id::travel_low_m:
      return rig_.rig.travel_m[0];
    case Id::travel_high_m:
      return rig_.rig.travel_m[1];
    case Id::travel_margin_m:
      return rig_.travel_margin_m;
    case Id::greatest_speed_m_per_s:
      return rig_.greatest_speed_m_per_s;
    case Id::host_timeout_s:
      return rig_.host_timeout_s;
    case Id::most_missed_ticks:
      return rig_.most_missed_ticks;
    case Id::state:
      return code(s.state);
    case Id::fault:
      return code(s.fault.fault);
    case Id::limited_by:
      return code(s.limited_by);
    case Id::experiment:
      return code(s.experiment);
    case Id::run_index:
      return s.run_index;
    case Id::run_count:
      return s.run_count;
    case Id::owner:
      return owner_;
    case Id::you:
      return client.number;
    case Id::tick:
      return static_cast<double>(s.tick);
    case Id::time_s:
      return s.time_s;
    case Id::progress:
      return s.progress;
    case Id::outcome:
      return code(s.outcome);
    case Id::missed_ticks:
      return s.missed_ticks;
    case Id::fault_tick:
      return static_cast<double>(s.fault_tick);
    case Id::live_reference_m:
      return s.reference_m;
    case Id::live_position_m:
      return s.position_m;
    case Id::live_voltage_V:
      return s.voltage_V;
    case Id::live_added_voltage_V:
      return s.added_V;
    case Id::live_current_A:
      return s.current_A;
    case Id::live_bus_voltage_V:
      return s.bus_V;
    case Id::live_motor_temperature_degC:
      return s.motor_C;
    case Id::live_velocity_m_per_s:
      return s.velocity_m_per_s;
    case Id::live_truth_position_m:
      return s.truth_position_m;
    case Id::live_truth_velocity_m_per_s:
      return s.truth_velocity_m_per_s;
    case Id::inputs:
      return s.inputs;
    case Id::lateness_median_us:
      return telemetry_.lateness.quantile_ns(0.5) * 1e-3;
    case Id::lateness_p99_us:
      return telemetry_.lateness.quantile_ns(0.99) * 1e-3;
    case Id::lateness_p999_us:
      return telemetry_.lateness.quantile_ns(0.999) * 1e-3;
    case Id::lateness_greatest_us:
      return telemetry_.lateness.greatest_ns() * 1e-3;
    case Id::step_time_median_us:
      return telemetry_.step_time.quantile_ns(0.5) * 1e-3;
    case Id::step_time_p99_us:
      return telemetry_.step_time.quantile_ns(0.99) * 1e-3;
    case Id::step_time_p999_us:
      return telemetry_.step_time.quantile_ns(0.999) * 1e-3;
    case Id::step_time_greatest_us:
      return telemetry_.step_time.greatest_ns() * 1e-3;
    case Id::ack_sequence:
      return own_ack_ != wire::Ack::none ? own_sequence_ : pending ? request_.sequence : s.ack_sequence;
    case Id::ack_result:
      return code(own_ack_ != wire::Ack::none ? own_ack_ : pending ? wire::Ack::pending : s.ack);
    case Id::ack_reason:
      return code(own_ack_ != wire::Ack::none ? own_reason_ : pending ? wire::Reason::none : s.reason);
    case Id::recording_count:
      return s.recordings;
    case Id::log_columns:
      return static_cast<double>(kLogColumns);
    case Id::log_frozen:
      return s.log_frozen ? 1 : 0;
    case Id::log_first_row:
      return static_cast<double>(exchange_.log.first_row());
    case Id::log_rows:
      return static_cast<double>(exchange_.log.rows());
    case Id::log_lost_rows:
      return static_cast<double>(s.lost_rows + exchange_.log.first_row());
    case Id::log_capacity:
      return static_cast<double>(exchange_.log.capacity());
    case Id::log_page_row:
      return static_cast<double>(client.page_row);
    case Id::log_page_rows:
      return client.page_rows;
    case Id::log_page_crc:
      return client.page_crc;
    default:
      break;
  }
  if (between(id, Id::active_kp_V_per_m, Id::active_ki_V_per_m_s)) {
    return gain(s.gains, place(id, Id::active_kp_V_per_m));
  }
  if (between(id, Id::live_compensation, Id::notice_time_s)) return online_number(id, s);
  if (between(id, Id::gain_slot, Id::slot2_ki_V_per_m_s)) return gain_number(id);
  if (between(id, Id::recording_select, Id::recording_ki_V_per_m_s))
    return recording_number(id, client, recording);
  return settings_[id];
}

double RegisterFile::online_number(Id id, const Status& s) const {
  if (between(id, Id::estimate_a_V_s_per_m, Id::estimate_f_V)) {
    if (s.compensation != CompensationMode::adaptive) return Status::kNothing;
    return s.adaptive.value[place(id, Id::estimate_a_V_s_per_m)];
  }
  if (between(id, Id::identified_gain_m_per_s2_V, Id::identified_coulomb_m_per_s2_high)) {
    const std::size_t at = place(id, Id::identified_gain_m_per_s2_V);
    const OnlineEstimate* const all[] = {&s.identified.gain_m_per_s2_V, &s.identified.viscous_per_s,
                                         &s.identified.coulomb_m_per_s2};
    const OnlineEstimate& e = *all[at / 3];
    return at % 3 == 0 ? e.value : at % 3 == 1 ? e.low : e.high;
  }
  switch (id) {
    case Id::live_compensation:
      return code(s.compensation);
    case Id::live_compensation_V:
      return s.compensation_V;
    case Id::live_sliding_m_per_s:
      return s.sliding_m_per_s;
    case Id::estimate_limits:
      return s.limits_met;
    case Id::identified_windows:
      return s.identified.windows;
    case Id::innovation_m_per_s2:
      return s.innovation_m_per_s2;
    case Id::innovation_limit_m_per_s2:
      return s.innovation_limit_m_per_s2;
    case Id::notice:
      return code(s.notice);
    case Id::notice_count:
      return s.notices;
    default:
      return s.notice_time_s;
  }
}

double RegisterFile::gain_number(Id id) const {
  if (id == Id::gain_slot) return gains_.active();
  const bool second = id >= Id::slot2_valid;
  const auto& slot = gains_.slot(second ? 2 : 1);
  const std::size_t at = place(id, second ? Id::slot2_valid : Id::slot1_valid);
  if (at == 0) return slot ? 1 : 0;
  if (!slot) return 0;
  return at == 1 ? slot->generation : gain(slot->gains, at - 2);
}

double RegisterFile::recording_number(Id id, const Client& client, const RecordingEntry& r) const {
  switch (id) {
    case Id::recording_select:
      return client.recording;
    case Id::recording_experiment:
      return code(r.kind);
    case Id::recording_first_row:
      return static_cast<double>(r.first_row);
    case Id::recording_rows:
      return r.rows;
    case Id::recording_lost_rows: {
      const std::uint64_t first = exchange_.log.first_row();
      const std::uint64_t gone =
          first > r.first_row ? std::min<std::uint64_t>(r.rows, first - r.first_row) : 0;
      return static_cast<double>(r.missed_rows + gone);
    }
    case Id::recording_law:
      return code(r.law);
    case Id::recording_ki_V_per_m_s:
      return r.pd.ki_V_per_m_s;
    case Id::recording_h1_V:
      return r.relay.h1_V;
    case Id::recording_h2_V:
      return r.relay.h2_V;
    case Id::recording_hysteresis_m:
      return r.relay.hysteresis_m;
    case Id::recording_repeat_of:
      return r.repeat_of;
    case Id::recording_outcome:
      return code(r.outcome);
    default:
      return gain(r.pd, place(id, Id::recording_kp_V_per_m));
  }
}

std::string RegisterFile::text(Id id, const Status& s, const RecordingEntry& recording) const {
  switch (id) {
    case Id::firmware_version:
      return CARTWRIGHT_VERSION;
    case Id::rig_name:
      return rig_.rig.name;
    case Id::fault_text:
      return sentence(s);
    case Id::recording_file:
      return std::string(recording.file.view());
    case Id::log_schema:
      return log_schema();
    case Id::notice_text:
      return notice_sentence(s);
    case Id::ack_text:
      break;
    default:
      return {};
  }
  if (own_ack_ != wire::Ack::none) return own_text_;
  if (!exchange_.requests.empty() || s.ack != wire::Ack::refused) return {};
  if (s.reason == wire::Reason::wrong_state && s.state == wire::State::faulted) {
    return "the controller is faulted; the command reset ends that, fetch the log first";
  }
  if (s.reason == wire::Reason::wrong_state) {
    return fmt::format("the controller is {}: {}", wire::name(s.state), wire::words(s.reason));
  }
  if (s.reason == wire::Reason::fault_present) {
    return fmt::format("{}: {}", wire::words(s.reason), sentence(s.present));
  }
  return std::string(wire::words(s.reason));
}

}  // namespace cartwright::firmware
