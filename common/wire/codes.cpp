#include "common/wire/codes.hpp"

#include <array>
#include <cstddef>

namespace cartwright::wire {
namespace {

struct Entry {
  std::string_view name, words;
};

template <std::size_t size, typename Code>
const Entry& look_up(const std::array<Entry, size>& table, Code code) {
  static constexpr Entry kUnknown{"unknown", "a code that this version does not know"};
  const auto index = static_cast<std::size_t>(code);
  return index < size ? table[index] : kUnknown;
}

constexpr std::array<Entry, kStateCount> kStates{{
    {"disarmed", "amplifier off"},
    {"armed", "amplifier on at zero volts, ready to run"},
    {"running", "an experiment has the cart"},
    {"faulted", "amplifier off until a reset; the log is frozen"},
}};

constexpr std::array<Entry, kFaultCount> kFaults{{
    {"none", "no fault"},
    {"emergency_stop", "the emergency stop is pressed"},
    {"end_stop", "the cart touched an end stop"},
    {"travel_limit", "the cart left the travel it is allowed, less the margin"},
    {"encoder_dead", "the encoder gives no valid reading"},
    {"encoder_jump", "the reading moved faster than the cart can"},
    {"encoder_stuck", "the reading stood still under voltage: the encoder is stuck or the cart is blocked"},
    {"encoder_late", "the encoder's readings are too old to control with"},
    {"amplifier_dead", "the amplifier does not answer"},
    {"amplifier_fault", "the amplifier reports a fault of its own"},
    {"command_not_finite", "the control law gave a voltage that is not a finite number"},
    {"missed_ticks", "the loop missed more ticks in a row than the rig allows"},
    {"lost_host", "the commanding host went silent while an experiment ran"},
}};

constexpr std::array<Entry, kLimitedCount> kLimits{{
    {"nothing", "nothing holds the output back"},
    {"voltage", "the output is held at the voltage limit"},
    {"slew", "the output changes no faster than the slew limit"},
}};

constexpr std::array<Entry, kExperimentKindCount> kExperiments{{
    {"none", "no experiment"},
    {"step", "steps of the reference: single, alternating or a ladder"},
    {"relay", "dual relay until the limit cycle has converged or clearly will not"},
    {"track", "a multisine or sine reference"},
    {"sweep", "slow traverses both ways at several speeds"},
    {"dither", "a multisine voltage on top of a PD hold"},
    {"hold", "holds a position"},
    {"battery", "the standard set of ten recordings for identification"},
}};

constexpr std::array<Entry, kOutcomeCount> kOutcomes{{
    {"none", "nothing has run yet"},
    {"running", "running"},
    {"finished", "ran to its end"},
    {"stopped", "stopped by a command"},
    {"converged", "the limit cycle converged"},
    {"not_converged", "ended without a converged limit cycle"},
    {"faulted", "ended by a fault"},
}};

constexpr std::array<Entry, kCommandCount> kCommands{{
    {"none", "nothing"},
    {"arm", "disarmed to armed: switches the amplifier on, at zero volts"},
    {"disarm", "any state but faulted to disarmed"},
    {"stop", "ends the running experiment; the controller stays armed"},
    {"reset", "leaves faulted for disarmed; fetch the log first, it goes on after this"},
    {"run", "armed to running, with the experiment set up in experiment_kind and its registers"},
    {"store_gains", "writes the staged gains into the inactive slot, then makes that slot the active one"},
    {"activate_gains", "makes slot command_argument (1 or 2) the active one"},
    {"release", "gives up command, so that another client can take it"},
    {"set_compensation", "uses the model and the settings of compensation_mode and after, between two ticks"},
    {"restart_identification", "forgets what was identified while running, and lets go of the notice"},
}};

constexpr std::array<Entry, kAckCount> kAcks{{
    {"none", "no command yet"},
    {"pending", "not yet carried out"},
    {"done", "obeyed"},
    {"refused", "refused; ack_reason and ack_text say why"},
}};

constexpr std::array<Entry, kReasonCount> kReasons{{
    {"none", "not refused"},
    {"wrong_state", "this command needs another state"},
    {"fault_present", "a fault condition is present; it must go away first"},
    {"bad_setup", "the experiment cannot be run as it is set up"},
    {"bad_slot", "that gain slot holds no valid gains"},
    {"not_stored", "the gain file cannot be written"},
    {"unknown_command", "no such command"},
}};

constexpr std::array<Entry, kNoticeCount> kNotices{{
    {"none", "nothing to notice"},
    {"model_mismatch", "what the rig does has stopped matching the model"},
    {"compensation_limit", "the friction compensation has met a limit: its model is far from the rig"},
}};

}  // namespace

std::string_view name(State code) {
  return look_up(kStates, code).name;
}
std::string_view name(Fault code) {
  return look_up(kFaults, code).name;
}
std::string_view name(Limited code) {
  return look_up(kLimits, code).name;
}
std::string_view name(ExperimentKind code) {
  return look_up(kExperiments, code).name;
}
std::string_view name(Outcome code) {
  return look_up(kOutcomes, code).name;
}
std::string_view name(Command code) {
  return look_up(kCommands, code).name;
}
std::string_view name(Ack code) {
  return look_up(kAcks, code).name;
}
std::string_view name(Reason code) {
  return look_up(kReasons, code).name;
}
std::string_view words(State code) {
  return look_up(kStates, code).words;
}
std::string_view words(Fault code) {
  return look_up(kFaults, code).words;
}
std::string_view words(Limited code) {
  return look_up(kLimits, code).words;
}
std::string_view words(ExperimentKind code) {
  return look_up(kExperiments, code).words;
}
std::string_view words(Outcome code) {
  return look_up(kOutcomes, code).words;
}
std::string_view words(Command code) {
  return look_up(kCommands, code).words;
}
std::string_view words(Ack code) {
  return look_up(kAcks, code).words;
}
std::string_view words(Reason code) {
  return look_up(kReasons, code).words;
}
std::string_view name(Notice code) {
  return look_up(kNotices, code).name;
}
std::string_view words(Notice code) {
  return look_up(kNotices, code).words;
}

std::optional<ExperimentKind> find_experiment(std::string_view wanted) {
  for (std::size_t i = 1; i < kExperiments.size(); ++i) {
    if (kExperiments[i].name == wanted) return static_cast<ExperimentKind>(i);
  }
  return std::nullopt;
}

}  // namespace cartwright::wire
