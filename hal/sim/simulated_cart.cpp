#include "hal/sim/simulated_cart.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright::hal::sim {
namespace {

/// A wall stands this far behind its switch.
constexpr double kWallBehindSwitch_m = 0.01;

PlantOptions options_of(const CartSetup& setup, bool disturbed, double heating_start_s) {
  PlantOptions options;
  options.step_s = setup.plant_step_s;
  options.disturbance_active = disturbed;
  options.heating_start_s = heating_start_s;
  return options;
}

}  // namespace

SimulatedCart::SimulatedCart(const CartSetup& setup, const Faults& faults)
    : setup_(setup),
      faults_(faults),
      plant_(setup.model, options_of(setup, false, 0)),
      encoder_(setup.model, setup.encoder_resolution_m, setup.seed) {
  plant_.reset(setup.start_position_m);
}

void SimulatedCart::advance_to(std::int64_t now_ns) noexcept {
  if (start_ns_ < 0) start_ns_ = now_ns_ = now_ns;
  if (now_ns <= now_ns_) return;
  const bool driven = command_.enabled && now_ns_ < faults_.amplifier_dead_ns &&
                      now_ns_ < faults_.amplifier_fault_ns && now_ns_ < faults_.emergency_stop_ns;
  delivered_V_ =
      driven ? std::clamp(command_.voltage_V, -setup_.amplifier_limit_V, setup_.amplifier_limit_V) : 0;
  plant_.advance(delivered_V_, static_cast<double>(now_ns - now_ns_) * 1e-9);
  stop_at_walls();
  now_ns_ = now_ns;
}

void SimulatedCart::stop_at_walls() noexcept {
  const PlantState& state = plant_.state();
  const double low = setup_.low_end_m - kWallBehindSwitch_m;
  const double high = setup_.high_end_m + kWallBehindSwitch_m;
  if (state.position_m < low && state.velocity_m_per_s < 0) plant_.correct(low, 0);
  if (state.position_m > high && state.velocity_m_per_s > 0) plant_.correct(high, 0);
}

void SimulatedCart::read(const Tick& tick, Measurement& measurement) noexcept {
  advance_to(tick.now_ns);
  const double elapsed_s = readings_ == 0 ? 0 : static_cast<double>(tick.now_ns - read_ns_) * 1e-9;
  read_ns_ = tick.now_ns;
  const PlantState& state = plant_.state();
  double position_m = encoder_.read(state.position_m, state.velocity_m_per_s, elapsed_s);
  if (tick.now_ns >= faults_.encoder_jump_ns) position_m += faults_.jump_m;
  if (tick.now_ns >= faults_.encoder_stuck_ns) position_m = last_.position_m;
  const auto sequence = static_cast<std::uint32_t>(readings_);
  history_[readings_ % kHistory] = {position_m, tick.now_ns, sequence};
  ++readings_;
  if (tick.now_ns >= faults_.encoder_dead_ns) {
    measurement = last_;
    measurement.age_ns = tick.now_ns - last_.timestamp_ns;
    measurement.validity = Validity::invalid;
    return;
  }
  const std::int64_t latency_ns = tick.now_ns >= faults_.encoder_late_ns ? faults_.latency_ns : 0;
  const Reading reading = reading_before(tick.now_ns - latency_ns);
  last_ = {reading.position_m, reading.timestamp_ns, tick.now_ns - reading.timestamp_ns, reading.sequence,
           Validity::valid};
  measurement = last_;
}

SimulatedCart::Reading SimulatedCart::reading_before(std::int64_t time_ns) const noexcept {
  const std::size_t held = std::min(readings_, kHistory);
  for (std::size_t back = 1; back < held; ++back) {
    const Reading& candidate = history_[(readings_ - back) % kHistory];
    if (candidate.timestamp_ns <= time_ns) return candidate;
  }
  return history_[(readings_ - held) % kHistory];
}

void SimulatedCart::report(const Tick& tick, AmplifierReport& report) noexcept {
  report = {};
  report.health = tick.now_ns >= faults_.amplifier_dead_ns    ? AmplifierHealth::silent
                  : tick.now_ns >= faults_.amplifier_fault_ns ? AmplifierHealth::fault
                                                              : AmplifierHealth::good;
}

void SimulatedCart::write(const Tick& tick, const Command& command) noexcept {
  advance_to(tick.now_ns);
  const bool late = tick.now_ns >= faults_.command_late_ns;
  command_ = late ? next_command_ : command;
  next_command_ = command;
  // Letting go does not wait for the late answer: the enable line is a wire of its own.
  command_.enabled = command_.enabled && command.enabled;
}

void SimulatedCart::read(const Tick& tick, Inputs& inputs) noexcept {
  advance_to(tick.now_ns);
  inputs.emergency_stop = tick.now_ns >= faults_.emergency_stop_ns;
  inputs.low_end_stop = plant_.state().position_m <= setup_.low_end_m;
  inputs.high_end_stop = plant_.state().position_m >= setup_.high_end_m;
  inputs.validity = Validity::valid;
}

Truth SimulatedCart::truth() const noexcept {
  return {plant_.state().position_m, plant_.state().velocity_m_per_s};
}

void SimulatedCart::set_model(const Model& model) {
  setup_.model = model;
  Plant next(model, options_of(setup_, false, 0));
  next.reset(plant_.state());
  plant_ = next;
}

void SimulatedCart::recording_started(std::string_view file) noexcept {
  // The disturbance's start and the motor's warming are counted from the start of a recording.
  PlantState state = plant_.state();
  state.time_s = 0;
  plant_ = Plant(setup_.model, options_of(setup_, file == setup_.model.disturbance_recording, 0));
  plant_.reset(state);
}

}  // namespace cartwright::hal::sim
