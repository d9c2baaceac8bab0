#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "common/control/compensation.hpp"
#include "common/control/dual_relay.hpp"
#include "common/control/pid.hpp"
#include "common/identify/online_identifier.hpp"
#include "common/wire/codes.hpp"
#include "firmware/compensation_setup.hpp"
#include "firmware/programme.hpp"
#include "firmware/supervisor.hpp"

namespace cartwright::firmware {

/// What the loop shows of itself after every tick.
struct Status {
  static constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

  wire::State state = wire::State::disarmed;
  wire::Limited limited_by = wire::Limited::nothing;
  wire::ExperimentKind experiment = wire::ExperimentKind::none;
  wire::Outcome outcome = wire::Outcome::none;
  wire::Ack ack = wire::Ack::none;
  wire::Reason reason = wire::Reason::none;
  std::uint16_t ack_sequence = 0;
  std::uint16_t run_index = 0, run_count = 0;
  std::uint16_t inputs = 0;  ///< bits as in the register `inputs`
  bool log_frozen = false;
  std::uint32_t missed_ticks = 0, recordings = 0;
  std::uint64_t tick = 0, fault_tick = 0, lost_rows = 0;
  FaultReport fault;
  FaultReport present;  ///< what would be a fault if the controller were armed
  double time_s = 0, fault_time_s = 0, progress = 0;
  double reference_m = 0, position_m = 0, voltage_V = 0, added_V = 0, velocity_m_per_s = 0;
  double current_A = kNothing, bus_V = kNothing, motor_C = kNothing;
  double truth_position_m = kNothing, truth_velocity_m_per_s = kNothing;
  PidGains gains;  ///< active

  CompensationMode compensation = CompensationMode::off;
  double compensation_V = 0, sliding_m_per_s = 0;
  AdaptiveEstimates adaptive;
  std::uint16_t limits_met = 0;
  OnlineEstimates identified;
  double innovation_m_per_s2 = kNothing, innovation_limit_m_per_s2 = kNothing;
  wire::Notice notice = wire::Notice::none;
  std::uint32_t notices = 0;
  double notice_time_s = kNothing;
};

/// A stretch of the log that is one recording.
struct RecordingEntry {
  FileName file;
  wire::ExperimentKind kind = wire::ExperimentKind::none;
  wire::Outcome outcome = wire::Outcome::none;
  wire::Law law = wire::Law::none;
  std::uint16_t repeat_of = 0;  ///< 1 + the recording it repeats, 0 for none
  std::uint32_t rows = 0, missed_rows = 0;
  std::uint64_t first_row = 0;
  PidGains pd;  ///< ki 0: the PD law
  DualRelayGains relay;
};

/// A command on its way to the loop.
struct Request {
  std::uint16_t sequence = 0;
  wire::Command command = wire::Command::none;
  PidGains gains;                  ///< of store_gains and activate_gains, checked
  Programme programme;             ///< of run, made ready
  CompensationSetup compensation;  ///< of set_compensation, made ready
};

/// The fault in one line: what, when and with which numbers.
std::string sentence(const Status& status);
/// The same for a condition that is present before arming.
std::string sentence(const FaultReport& report);
/// The notice in one line; empty where there is none.
std::string notice_sentence(const Status& status);

}  // namespace cartwright::firmware
