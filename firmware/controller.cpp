#include "firmware/controller.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/experiments/reference_motion.hpp"

namespace cartwright::firmware {
namespace {

using wire::Outcome;
using wire::Reason;
using wire::State;

/// The laws run unlimited: the output stage limits, and says so.
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
/// Rest between arriving at the start of a run and its first row: the cart has stopped ringing by then.
constexpr double kSettle_s = 0.5;
constexpr double kLeastApproach_s = 0.3;
/// How fast bumpless transfer lets go of the old gains' voltage: slow against the loop, fast against an
/// experiment.
constexpr double kBump_s = 0.2;

/// Point-to-point motion of least jerk, 10 x^3 - 15 x^4 + 6 x^5 for x in [0, 1] (Flash and Hogan 1985); its
/// greatest speed is 15/8 of the mean.
double least_jerk(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}
constexpr double kPeakOverMean = 15.0 / 8;

template <typename Visit>
auto with(decltype(Run::experiment)& experiment, Visit visit) noexcept {
  if (auto* step = std::get_if<Step>(&experiment)) return visit(*step);
  if (auto* relay = std::get_if<Relay>(&experiment)) return visit(*relay);
  if (auto* track = std::get_if<Track>(&experiment)) return visit(*track);
  if (auto* sweep = std::get_if<Sweep>(&experiment)) return visit(*sweep);
  if (auto* dither = std::get_if<Dither>(&experiment)) return visit(*dither);
  return visit(*std::get_if<Hold>(&experiment));
}

double duration_s(Run& run) noexcept {
  return with(run.experiment, [](auto& experiment) { return experiment.duration_s(); });
}

OnlineSetup online_setup(const ControllerSetup& setup) {
  OnlineSetup out;
  out.rows.period_s = setup.period_s;
  out.rows.step_m = setup.bounds.resolution_m;
  out.voltage_limit_V = setup.voltage_limit_V;
  return out;
}

}  // namespace

Controller::Controller(const ControllerSetup& setup, const hal::Devices& devices, Exchange& exchange)
    : setup_(setup),
      devices_(devices),
      exchange_(exchange),
      output_(setup.voltage_limit_V, setup.slew_limit_V_per_s),
      supervisor_(setup.bounds),
      approach_law_({setup.approach_kp_V_per_m, setup.approach_kd_V_s_per_m, 50, false}, setup.period_s,
                    kNoLimit),
      pd_law_(setup.gains, setup.period_s, kNoLimit, setup.voltage_limit_V),
      relay_law_({}, setup.period_s, kNoLimit),
      bump_decay_(std::exp(-setup.period_s / kBump_s)),
      compensation_(setup.period_s),
      online_(online_setup(setup)) {
  status_.gains = setup.gains;
  change_compensation(setup.compensation);
}

void Controller::tick(const hal::Tick& tick, double lateness_s, std::uint32_t missed) noexcept {
  if (start_ns_ < 0) start_ns_ = tick.now_ns;
  status_.time_s = static_cast<double>(tick.now_ns - start_ns_) / 1e9;
  status_.missed_ticks += missed;
  devices_.inputs->read(tick, readings_.inputs);
  devices_.encoder->read(tick, readings_.measurement);
  devices_.amplifier->report(tick, readings_.amplifier);
  const double y_m = readings_.measurement.position_m;
  const double period_s = static_cast<double>(tick.period_ns) * 1e-9;

  status_.present = supervisor_.watch(readings_, period_s, last_output_V_, missed);
  const Request* const request = exchange_.requests.peek();
  if (request) obey(*request);
  const bool was_live = status_.state == State::armed || status_.state == State::running;
  if (was_live) latch(status_.present);
  if (status_.state == State::running && exchange_.host_lost.load(std::memory_order_acquire)) {
    latch({wire::Fault::lost_host, 0, setup_.bounds.host_timeout_s});
  }

  Wanted wanted;
  OutputStage::Result out;
  if (status_.state == State::running) wanted = run(y_m);
  if (was_live) {
    out = output_.shape(wanted.voltage_V, setup_.period_s);
    latch(supervisor_.judge(readings_, out.voltage_V, out.finite));
  }
  const bool live = status_.state == State::armed || status_.state == State::running;
  if (!live) {
    out.voltage_V = 0;
    output_.cut();
  }
  devices_.amplifier->write(tick, {out.voltage_V, live});
  last_output_V_ = out.voltage_V;
  status_.limited_by = live ? out.limited_by : wire::Limited::nothing;
  identify(tick, wanted, out.voltage_V);
  take_notice();
  if (was_live) log(tick, lateness_s, missed, wanted, out.voltage_V);
  status_.log_frozen = status_.state == State::faulted;
  show(wanted, out.voltage_V);
  if (request) exchange_.requests.taken();  // only now: an empty box means that the answer can be read
  ++status_.tick;
}

void Controller::obey(const Request& request) noexcept {
  status_.reason = carry_out(request);
  status_.ack_sequence = request.sequence;
  status_.ack = status_.reason == Reason::none ? wire::Ack::done : wire::Ack::refused;
}

Reason Controller::carry_out(const Request& request) noexcept {
  switch (request.command) {
    case wire::Command::arm:
      return arm();
    case wire::Command::disarm:
      if (status_.state == State::faulted) return Reason::wrong_state;
      if (status_.state == State::running) finish(Outcome::stopped);
      status_.state = State::disarmed;
      return Reason::none;
    case wire::Command::stop:
      if (status_.state != State::running) return Reason::wrong_state;
      finish(Outcome::stopped);
      return Reason::none;
    case wire::Command::reset:
      if (status_.state != State::faulted) return Reason::wrong_state;
      supervisor_.restart();
      status_.state = State::disarmed;
      status_.fault = {};
      return Reason::none;
    case wire::Command::run:
      if (status_.state != State::armed) return Reason::wrong_state;
      start(request.programme);
      return Reason::none;
    case wire::Command::store_gains:
    case wire::Command::activate_gains:
      change_gains(request.gains);
      return Reason::none;
    case wire::Command::set_compensation:
      change_compensation(request.compensation);
      return Reason::none;
    case wire::Command::restart_identification:
      online_.restart();
      return Reason::none;
    default:
      return Reason::unknown_command;
  }
}

Reason Controller::arm() noexcept {
  if (status_.state != State::disarmed) return Reason::wrong_state;
  if (status_.present.fault != wire::Fault::none) return Reason::fault_present;
  supervisor_.restart();
  output_.cut();
  status_.state = State::armed;
  return Reason::none;
}

void Controller::start(const Programme& programme) noexcept {
  programme_ = programme;
  if (status_.recordings + programme.count > Exchange::kMostRecordings) status_.recordings = 0;
  first_recording_ = status_.recordings;
  run_ = 0;
  done_s_ = total_s_ = 0;
  for (std::size_t i = 0; i < programme_.count; ++i) total_s_ += duration_s(programme_.runs[i]);
  status_.state = State::running;
  status_.outcome = Outcome::running;
  status_.experiment = programme.kind;
  status_.run_count = static_cast<std::uint16_t>(programme.count);
  begin_run(readings_.measurement.position_m);
}

void Controller::change_gains(const PidGains& gains) noexcept {
  status_.gains = gains;
  gains_pending_ = status_.state == State::running && phase_ == Phase::record && gains_follow_;
}

/// Inside a recording without a bump, else at once.
void Controller::change_compensation(const CompensationSetup& setup) noexcept {
  compensation_.set(setup.law);
  if (!recording()) compensation_.restart(setup_.gains.pd);
  online_.set_model(setup.model);
}

/// Bumpless transfer: whatever the new gains would take away from or add to the voltage at this tick is made
/// up for, and let go of slowly.
void Controller::take_new_gains(const Wanted& wanted, double y_m) noexcept {
  gains_pending_ = false;
  gains_changed_ = true;
  compensation_.set_feedback(status_.gains.pd);
  online_.end();  // the twin goes by the gains of the recording's start
  PidController before = pd_law_;
  pd_law_.set(status_.gains, setup_.period_s);
  PidController after = pd_law_;
  bump_V_ += before.update(wanted.reference_m, y_m) - after.update(wanted.reference_m, y_m);
}

Controller::Wanted Controller::run(double y_m) noexcept {
  return phase_ == Phase::record ? record(y_m) : approach(y_m);
}

void Controller::begin_run(double y_m) noexcept {
  Run& run = programme_.runs[run_];
  status_.run_index = static_cast<std::uint16_t>(run_ + 1);
  const double start_m = with(run.experiment, [](auto& experiment) { return experiment.start_m(); });
  approach_from_m_ = y_m;
  approach_s_ =
      std::max(kLeastApproach_s, kPeakOverMean * std::abs(start_m - y_m) / setup_.approach_speed_m_per_s);
  approach_law_.reset();
  phase_ = Phase::approach;
  phase_tick_ = 0;
}

Controller::Wanted Controller::approach(double y_m) noexcept {
  const double time_s = static_cast<double>(phase_tick_++) * setup_.period_s;
  const double start_m =
      with(programme_.runs[run_].experiment, [](auto& experiment) { return experiment.start_m(); });
  Wanted wanted;
  wanted.reference_m = approach_from_m_ + (start_m - approach_from_m_) * least_jerk(time_s / approach_s_);
  wanted.voltage_V = approach_law_.update(wanted.reference_m, y_m);
  if (time_s < approach_s_ + kSettle_s) return wanted;
  begin_recording();
  return record(y_m);
}

void Controller::begin_recording() noexcept {
  const Run& run = programme_.runs[run_];
  phase_ = Phase::record;
  phase_tick_ = 0;
  bump_V_ = 0;
  gains_changed_ = false;
  const auto* relay = std::get_if<DualRelayGains>(&run.law);
  const auto* own = std::get_if<PdGains>(&run.law);
  relay_active_ = relay != nullptr;
  gains_follow_ = !relay && !own;
  entry_ = {};
  entry_.file = run.file;
  entry_.kind = run.kind;
  entry_.outcome = Outcome::running;
  entry_.first_row = exchange_.log.rows();
  if (run.repeat_of > 0) entry_.repeat_of = static_cast<std::uint16_t>(first_recording_ + run.repeat_of);
  if (relay) {
    relay_law_ = DualRelayController(*relay, setup_.period_s, kNoLimit);
    entry_.law = wire::Law::dual_relay;
    entry_.relay = *relay;
    online_.end();
  } else {
    entry_.pd = own ? PidGains{*own, 0} : status_.gains;
    entry_.law = wire::Law::pd;
    pd_law_ = PidController(entry_.pd, setup_.period_s, kNoLimit, setup_.voltage_limit_V);
    compensation_.restart(entry_.pd.pd);
    online_.begin(entry_.pd);
  }
  exchange_.recordings[status_.recordings].write(entry_);
  ++status_.recordings;
  if (devices_.simulation) devices_.simulation->recording_started(run.file.view());
}

Controller::Wanted Controller::record(double y_m) noexcept {
  Run& run = programme_.runs[run_];
  const double time_s = static_cast<double>(phase_tick_) * setup_.period_s;
  const bool over = time_s >= duration_s(run) - 0.5 * setup_.period_s;
  Demand demand = with(run.experiment, [&](auto& experiment) { return experiment.at(time_s, y_m); });
  if (over && demand.outcome == Outcome::running) {
    const auto* relay = std::get_if<Relay>(&run.experiment);
    demand.outcome = relay ? relay->verdict() : Outcome::finished;
  }
  if (demand.outcome != Outcome::running) {
    next_run(demand.outcome);
    return status_.state == State::running ? approach(y_m) : Wanted{};
  }
  ++phase_tick_;
  status_.progress = total_s_ > 0 ? (done_s_ + time_s) / total_s_ : 0;
  Wanted wanted{demand.reference_m, demand.added_V, 0};
  if (relay_active_) {
    wanted.voltage_V = relay_law_.update(wanted.reference_m, y_m, wanted.added_V);
    return wanted;
  }
  if (gains_pending_) take_new_gains(wanted, y_m);
  wanted.added_V += bump_V_ + compensation_V(run, time_s, wanted, y_m);
  bump_V_ *= bump_decay_;
  wanted.voltage_V = pd_law_.update(wanted.reference_m, y_m, wanted.added_V);
  return wanted;
}

double Controller::compensation_V(Run& run, double time_s, const Wanted& wanted, double y_m) noexcept {
  ReferenceMotion motion{wanted.reference_m, 0, 0};
  if (compensation_.active()) {
    with(run.experiment, [&](auto& experiment) {
      if constexpr (kSmooth<std::decay_t<decltype(experiment)>>) {
        motion = reference_motion(experiment, time_s, setup_.period_s);
      }
    });
  }
  return compensation_.update(motion, wanted.reference_m, y_m, status_.limited_by != wire::Limited::nothing);
}

void Controller::end_recording(Outcome outcome) noexcept {
  if (phase_ != Phase::record) return;
  entry_.outcome = outcome;
  entry_.rows = static_cast<std::uint32_t>(exchange_.log.rows() - entry_.first_row);
  exchange_.recordings[status_.recordings - 1].write(entry_);
  phase_ = Phase::approach;
}

void Controller::next_run(Outcome outcome) noexcept {
  end_recording(outcome);
  done_s_ += duration_s(programme_.runs[run_]);
  if (run_ + 1 < programme_.count) {
    ++run_;
    begin_run(readings_.measurement.position_m);
  } else {
    // Of several runs the battery as a whole is finished, however each of them ended.
    finish(programme_.count == 1 ? outcome : Outcome::finished);
    status_.progress = 1;
  }
}

void Controller::finish(Outcome outcome) noexcept {
  end_recording(outcome);
  status_.outcome = outcome;
  status_.state = State::armed;
  gains_pending_ = false;
}

void Controller::latch(const FaultReport& report) noexcept {
  if (report.fault == wire::Fault::none || status_.state == State::faulted) return;
  if (status_.state == State::running) finish(Outcome::faulted);
  status_.state = State::faulted;
  status_.fault = report;
  status_.fault_tick = status_.tick;
  status_.fault_time_s = status_.time_s;
}

}  // namespace cartwright::firmware
