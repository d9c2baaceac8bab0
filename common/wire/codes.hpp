#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace cartwright::wire {

/// What the supervisor lets the loop do.
enum class State : std::uint16_t {
  disarmed,  ///< amplifier off; the log stands still
  armed,     ///< amplifier on at zero volts, ready to run
  running,   ///< an experiment has the cart
  faulted,   ///< amplifier off until a reset; the log is frozen
};
inline constexpr std::uint16_t kStateCount = 4;

/// Why the supervisor took the voltage away. Sticky: the first one stays until a reset.
enum class Fault : std::uint16_t {
  none,
  emergency_stop,
  end_stop,
  travel_limit,
  encoder_dead,
  encoder_jump,
  encoder_stuck,
  encoder_late,
  amplifier_dead,
  amplifier_fault,
  command_not_finite,
  missed_ticks,
  lost_host,
};
inline constexpr std::uint16_t kFaultCount = 13;

/// What holds the output back. Not a fault: an experiment may well run into the voltage limit.
enum class Limited : std::uint16_t { nothing, voltage, slew };
inline constexpr std::uint16_t kLimitedCount = 3;

enum class ExperimentKind : std::uint16_t { none, step, relay, track, sweep, dither, hold, battery };
inline constexpr std::uint16_t kExperimentKindCount = 8;

/// How the last experiment ended.
enum class Outcome : std::uint16_t { none, running, finished, stopped, converged, not_converged, faulted };
inline constexpr std::uint16_t kOutcomeCount = 7;

/// What a client can ask for in `command_code`.
enum class Command : std::uint16_t {
  none,
  arm,
  disarm,
  stop,
  reset,
  run,
  store_gains,
  activate_gains,
  release,
  set_compensation,
  restart_identification
};
inline constexpr std::uint16_t kCommandCount = 11;

/// Whether the command numbered `ack_sequence` was obeyed.
enum class Ack : std::uint16_t { none, pending, done, refused };
inline constexpr std::uint16_t kAckCount = 4;

/// Why a command was refused.
enum class Reason : std::uint16_t {
  none,
  wrong_state,
  fault_present,
  bad_setup,
  bad_slot,
  not_stored,
  unknown_command,
};
inline constexpr std::uint16_t kReasonCount = 7;

/// Control law of a recording.
enum class Law : std::uint16_t { none, pd, dual_relay };

/// What is worth knowing and stops nothing.
enum class Notice : std::uint16_t { none, model_mismatch, compensation_limit };
inline constexpr std::uint16_t kNoticeCount = 3;

/// Bits of the log's `status` column: state in bits 0-3, these, and the fault's number in bits 8-15.
inline constexpr std::uint32_t kStatusGainsChanged = 1U << 4U;
inline constexpr std::uint32_t kStatusMeasurementLate = 1U << 5U;
inline constexpr std::uint32_t kStatusApproaching =
    1U << 6U;  ///< moving to the start of a run, outside recordings
inline constexpr std::uint32_t kStatusNotice = 1U << 7U;

/// The identifier of a code (`armed`, `lost_host`, ...), and what it means in one sentence.
std::string_view name(State state);
std::string_view name(Fault fault);
std::string_view name(Limited limited);
std::string_view name(ExperimentKind kind);
std::string_view name(Outcome outcome);
std::string_view name(Command command);
std::string_view name(Ack ack);
std::string_view name(Reason reason);
std::string_view name(Notice notice);
std::string_view words(State state);
std::string_view words(Fault fault);
std::string_view words(Limited limited);
std::string_view words(ExperimentKind kind);
std::string_view words(Outcome outcome);
std::string_view words(Command command);
std::string_view words(Ack ack);
std::string_view words(Reason reason);
std::string_view words(Notice notice);

std::optional<ExperimentKind> find_experiment(std::string_view name);

}  // namespace cartwright::wire
