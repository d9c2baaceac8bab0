#include "firmware/daemon.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>

#include "firmware/gain_store.hpp"
#include "firmware/modbus_server.hpp"
#include "firmware/realtime.hpp"
#include "firmware/session_writer.hpp"

namespace cartwright::firmware {
namespace {

/// Ten minutes at 1 kHz, with the way to the start before and the wait for the host after: the longest
/// recording there is can be fetched whole.
constexpr std::size_t kLogRows = 615'000;
constexpr std::int64_t kIdleRest_ns = 2'000'000;

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int) {
  stop_requested.store(true);
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGINT, &action, nullptr);
}

/// A controller with what it shares and the clock it runs on.
struct Machine {
  Machine(const RigFile& file, const hal::Devices& devices, const GainStore& gains)
      : exchange(kLogRows), controller(setup(file, gains), devices, exchange) {
    if (file.virtual_time) {
      pacer = std::make_unique<VirtualPacer>(kIdleRest_ns);
    } else {
      pacer = std::make_unique<RealPacer>();
    }
  }

  static ControllerSetup setup(const RigFile& file, const GainStore& gains) {
    ControllerSetup out = controller_setup(file);
    if (gains.active() > 0) out.gains = gains.slot(gains.active())->gains;
    return out;
  }

  Exchange exchange;
  Telemetry telemetry;
  Controller controller;
  std::unique_ptr<Pacer> pacer;
};

std::int64_t period_ns(const RigFile& rig) {
  return std::llround(1e9 * rig.rig.period_s());
}

Result<Settings> settings_from(const Options& options, const RigFile& rig) {
  Settings settings = rig.settings;
  const auto kind = wire::find_experiment(options.once);
  if (!kind) {
    return failure(fmt::format(
        "--once {}: no such experiment; they are step, relay, track, sweep, dither, hold, battery",
        options.once));
  }
  settings.set(wire::Id::experiment_kind, static_cast<double>(*kind));
  for (const std::string& entry : options.settings) {
    const auto equals = entry.find('=');
    const auto id = wire::find_register(entry.substr(0, equals));
    if (equals == std::string::npos || !id || !wire::info(*id).writable()) {
      return failure(
          fmt::format("--set {}: NAME=VALUE is needed, with a writable register; see --registers", entry));
    }
    const wire::Register& r = wire::info(*id);
    double value = 0;
    const char* const end = entry.data() + entry.size();
    const auto read = std::from_chars(entry.data() + equals + 1, end, value);
    if (read.ec != std::errc{} || read.ptr != end || !(value >= r.least && value <= r.most)) {
      return failure(fmt::format("--set {}: a number from {} to {} is needed", entry, r.least, r.most));
    }
    settings.set(*id, value);
  }
  return settings;
}

/// Does one command through the mailbox, as a host would.
bool obey(Machine& machine, Loop& loop, Request request) {
  request.sequence = static_cast<std::uint16_t>(machine.controller.status().ack_sequence + 1);
  machine.exchange.requests.post(request);
  while (!machine.exchange.requests.empty() && !stop_requested) loop.tick();
  return machine.controller.status().ack == wire::Ack::done;
}

/// One line on a terminal, over itself.
void show_progress(const Status& status) {
  const auto filled = static_cast<std::size_t>(40 * status.progress);
  std::fprintf(stderr, "\r%s",
               fmt::format("run {} of {} [{:40}] {:3.0f} %", status.run_index, status.run_count,
                           std::string(filled, '#'), 100 * status.progress)
                   .c_str());
}

Result<int> record_once(const Options& options, const RigFile& rig, Machine& machine) {
  if (options.out.empty()) return failure("--once needs --out DIR to write the recordings to");
  const auto settings = settings_from(options, rig);
  if (!settings) return tl::unexpected(settings.error());
  const auto programme = prepare(*settings, rig);
  if (!programme) return tl::unexpected(programme.error());
  Loop loop(machine.controller, *machine.pacer, period_ns(rig), machine.telemetry);
  loop.tick();
  Request arm, go, compensate;
  const auto compensation = compensation_from(*settings, rig);
  if (!compensation) return tl::unexpected(compensation.error());
  compensate.command = wire::Command::set_compensation;
  compensate.compensation = *compensation;
  arm.command = wire::Command::arm;
  go.command = wire::Command::run;
  go.programme = *programme;
  if (!obey(machine, loop, compensate) || !obey(machine, loop, arm) || !obey(machine, loop, go)) {
    return failure(fmt::format("cannot start: {}", sentence(machine.controller.status().present)));
  }
  const bool watched = ::isatty(STDERR_FILENO) == 1;
  for (std::uint64_t tick = 0; machine.controller.state() == wire::State::running && !stop_requested;
       ++tick) {
    loop.tick();
    if (watched && tick % 500 == 0) show_progress(machine.controller.status());
  }
  if (watched) std::fputs("\r\033[K", stderr);
  const Status& status = machine.controller.status();
  if (stop_requested) return failure("stopped before the experiment was over; nothing was written");
  const auto written = write_session(rig, machine.exchange, options.out);
  if (!written) return tl::unexpected(written.error());
  std::fprintf(stderr, "cartwrightd: %u %s in %s, %s\n", status.recordings,
               status.recordings == 1 ? "recording" : "recordings", options.out.c_str(),
               std::string(wire::words(status.outcome)).c_str());
  if (status.notice != wire::Notice::none) {
    std::fprintf(stderr, "cartwrightd: notice at %s\n", notice_sentence(status).c_str());
  }
  if (status.state == wire::State::faulted)
    std::fprintf(stderr, "cartwrightd: fault at %s\n", sentence(status).c_str());
  const bool complete =
      status.outcome == wire::Outcome::finished || status.outcome == wire::Outcome::converged;
  return complete ? 0 : 1;
}

/// What the loop measured of itself, in one line that a script can read.
void print(const Machine& machine) {
  const auto line = [](const char* what, const Histogram& histogram) {
    std::printf(" %s_us median %.1f p99 %.1f p999 %.1f greatest %.1f", what,
                histogram.quantile_ns(0.5) * 1e-3, histogram.quantile_ns(0.99) * 1e-3,
                histogram.quantile_ns(0.999) * 1e-3, histogram.greatest_ns() * 1e-3);
  };
  const Status& status = machine.controller.status();
  std::printf("cartwrightd: %llu ticks, %u missed,", static_cast<unsigned long long>(status.tick),
              status.missed_ticks);
  line("lateness", machine.telemetry.lateness);
  line("step", machine.telemetry.step_time);
  std::printf("\n");
}

Result<int> serve(const RigFile& rig, const hal::Devices& devices, Machine& machine, GainStore gains) {
  auto server = ModbusServer::listen(
      rig.listen, rig.port, RegisterFile(rig, machine.exchange, machine.telemetry, std::move(gains)));
  if (!server) return tl::unexpected(server.error());
  (*server)->start();
  std::printf("cartwrightd: ready on %s:%d, %s cart, %g Hz, %s time\n", rig.listen.c_str(), (*server)->port(),
              rig.kind.c_str(), rig.rig.sample_rate_hz, rig.virtual_time ? "virtual" : "real");
  std::fflush(stdout);
  Loop loop(machine.controller, *machine.pacer, period_ns(rig), machine.telemetry);
  loop.run(stop_requested);
  // The devices outlive the loop: leave them without voltage.
  devices.amplifier->write({machine.pacer->now_ns(), period_ns(rig)}, {0, false});
  print(machine);
  return 0;
}

}  // namespace

Result<RigFile> load_rig(const Options& options) {
  if (options.rig_file.empty())
    return failure(
        "--rig FILE is needed; examples are in share/doc/cartwright/examples, or firmware/examples of the "
        "source");
  auto rig = read_rig_file(options.rig_file);
  if (!rig) return rig;
  if (options.virtual_time) rig->virtual_time = true;
  if (options.port >= 0) rig->port = options.port;
  return rig;
}

Result<int> run(const Options& options, const RigFile& rig, const hal::Devices& devices) {
  auto gains = GainStore::open(rig.gain_file);
  if (!gains) return tl::unexpected(gains.error());
  for (const std::string& doubt : gains->doubts()) std::fprintf(stderr, "cartwrightd: %s\n", doubt.c_str());
  const auto machine = std::make_unique<Machine>(rig, devices, *gains);
  catch_signals();
  if (!rig.virtual_time) {
    Realtime realtime = prepare_process();
    prepare_thread(realtime);
    for (const std::string& line : realtime.missing) std::fprintf(stderr, "cartwrightd: %s\n", line.c_str());
    if (rig.kind != "simulated" && rig.require_realtime && !realtime.sufficient()) {
      return failure(
          "a real cart is not driven without SCHED_FIFO and locked memory; mend the above or write "
          "require_realtime = false in [rig]");
    }
  }
  if (!options.once.empty()) return record_once(options, rig, *machine);
  return serve(rig, devices, *machine, std::move(*gains));
}

}  // namespace cartwright::firmware
