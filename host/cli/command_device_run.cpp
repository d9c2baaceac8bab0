#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "host/cli/device_command.hpp"
#include "host/cli/device_pull.hpp"
#include "host/cli/experiment_options.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/progress.hpp"

namespace cartwright::cli {
namespace {

using device::Controller;
using wire::Id;

constexpr std::chrono::milliseconds kLook{50};

/// How an experiment ended, in the controller's words.
struct End {
  wire::Outcome outcome = wire::Outcome::none;
  std::string fault_text;
  bool interrupted = false;
};

device::Answer<End> wait_for_end(Controller& controller, wire::ExperimentKind kind) {
  ProgressBar bar{std::string(wire::name(kind))};
  const Interrupt interrupt;
  End end;
  while (true) {
    const auto now = controller.read(Id::state, Id::fault_text);
    if (!now) return tl::unexpected(now.error());
    end.outcome = now->code<wire::Outcome>(Id::outcome);
    end.fault_text = now->text(Id::fault_text);
    if (now->code<wire::State>(Id::state) != wire::State::running) return end;
    const auto runs = now->integer<int>(Id::run_count);
    bar.label(runs > 1 ? fmt::format("{} {:2} of {}", wire::name(kind), now->value(Id::run_index), runs)
                       : std::string(wire::name(kind)));
    bar.show(now->value(Id::progress));
    if (interrupt.requested() && !end.interrupted) {
      end.interrupted = true;
      if (const auto stopped = controller.command(wire::Command::stop); !stopped)
        return tl::unexpected(stopped.error());
    }
    std::this_thread::sleep_for(kLook);
  }
}

/// Arms if need be, runs, and leaves the controller as it was before.
Outcome run(const device::Address& address, wire::ExperimentKind kind, const ExperimentOptions& options,
            const std::string& out) {
  auto controller = Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto before = controller->read(Id::state);
  if (!before) return conclude(before.error());
  const auto recordings_before = device::recording_count(*controller);
  if (!recordings_before) return conclude(recordings_before.error());
  const bool was_disarmed = before->code<wire::State>(Id::state) == wire::State::disarmed;
  if (const auto written = controller->write(options.settings()); !written) return conclude(written.error());
  if (was_disarmed) {
    if (const auto armed = controller->command(wire::Command::arm); !armed) return conclude(armed.error());
  }
  const auto started = controller->command(wire::Command::run);
  const auto end =
      started ? wait_for_end(*controller, kind) : device::Answer<End>(tl::unexpected(started.error()));
  const bool faulted = end && end->outcome == wire::Outcome::faulted;
  if (was_disarmed && !faulted) {
    // Also after a refused run. If this fails too, the first trouble is the one to tell.
    const auto disarmed = controller->command(wire::Command::disarm);
    if (end && !disarmed) return conclude(disarmed.error());
  }
  if (!end) return conclude(end.error());
  fmt::print("{}: {}\n", wire::name(kind), wire::words(end->outcome));

  const auto recordings = device::recording_count(*controller);
  if (!recordings) return conclude(recordings.error());
  if (*recordings > *recordings_before && !out.empty()) {
    const Outcome pulled = pull_into(*controller, {*recordings_before, *recordings}, out);
    if (!pulled || *pulled != Status::done) return pulled;
  }
  if (faulted)
    fmt::print(stderr, "cartwright: fault: {}; see cartwright device reset --help\n", end->fault_text);
  const bool complete = end->outcome == wire::Outcome::finished || end->outcome == wire::Outcome::converged;
  return complete ? Status::done : Status::no;
}

std::string example(wire::ExperimentKind kind) {
  switch (kind) {
    case wire::ExperimentKind::step:
      return "step --amplitude-m 0.05 --kp-V-per-m 60 --kd-V-s-per-m 0 --out rig/step";
    case wire::ExperimentKind::relay:
      return "relay --h1-V 2 --h2-V 1.5 --out rig/relay";
    case wire::ExperimentKind::track:
      return "track --shape sine --low-hz 0.5 --amplitude-m 0.05 --out rig/sine";
    case wire::ExperimentKind::sweep:
      return "sweep --slowest-m-per-s 0.02 --fastest-m-per-s 0.2 --speeds 3 --out rig/sweep";
    case wire::ExperimentKind::dither:
      return "dither --amplitude-V 3 --low-hz 1 --high-hz 20 --out rig/dither";
    case wire::ExperimentKind::hold:
      return "hold --position-m 0.1 --duration-s 5";
    case wire::ExperimentKind::battery:
      return "battery --out rig/monday";
    case wire::ExperimentKind::none:
      break;
  }
  return "";
}

}  // namespace

void add_device_run(CLI::App& device, int& exit_status) {
  CLI::App* all = device.add_subcommand("run", "Run an experiment, and fetch what it recorded");
  all->require_subcommand(1);
  all->footer(
      "Arms the controller if it is disarmed, and disarms it again. Ctrl-C stops the experiment.\n"
      "Status 1: refused, stopped, faulted, or a relay test that did not converge.\n\n"
      "Examples:\n"
      "  cartwright device run battery --out rig/monday\n"
      "  cartwright device run step --help");
  for (std::uint16_t code = 1; code < wire::kExperimentKindCount; ++code) {
    const auto kind = static_cast<wire::ExperimentKind>(code);
    CLI::App* command = all->add_subcommand(std::string(wire::name(kind)), std::string(wire::words(kind)));
    command->footer("Example:\n  cartwright device run " + example(kind));
    const auto options = std::make_shared<ExperimentOptions>(command, kind);
    const auto address = add_address(command);
    auto out = std::make_shared<std::string>();
    command->add_option("--out", *out,
                        "directory to write the session to (default: leave it in the controller's log)");
    on_run(command, exit_status,
           [address, kind, options, out] { return run(*address, kind, *options, *out); });
  }
}

}  // namespace cartwright::cli
