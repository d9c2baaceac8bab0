#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/cli/device_command.hpp"
#include "host/cli/interrupt.hpp"

namespace cartwright::cli {
namespace {

using device::RegisterBlock;
using nlohmann::ordered_json;
using wire::Id;

struct Options {
  double interval_s = 0.1;
  bool once = false, json = false;
};

std::string as_json(const RegisterBlock& now) {
  ordered_json line;
  line["time_s"] = now.value(Id::time_s);
  line["state"] = wire::name(now.code<wire::State>(Id::state));
  line["fault"] = wire::name(now.code<wire::Fault>(Id::fault));
  line["limited_by"] = wire::name(now.code<wire::Limited>(Id::limited_by));
  line["experiment"] = wire::name(now.code<wire::ExperimentKind>(Id::experiment));
  line["progress"] = now.value(Id::progress);
  for (auto i = static_cast<std::size_t>(Id::live_reference_m);
       i <= static_cast<std::size_t>(Id::live_truth_velocity_m_per_s); ++i) {
    const wire::Register& what = wire::registers()[i];
    const double value = now.value(what.id);
    const std::string name(what.name.substr(std::string_view("live_").size()));
    line[name] = std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  }
  return line.dump();
}

/// A value within [low, high] as a mark on a scale.
std::string scale(double value, double low, double high) {
  constexpr int kWidth = 41;
  std::string line(kWidth, '-');
  const double part = (value - low) / (high - low);
  if (part >= 0 && part <= 1) line[static_cast<std::size_t>(std::lround(part * (kWidth - 1)))] = '#';
  return line;
}

/// The same number of lines every time, so that they can be drawn over.
constexpr int kLines = 5;
std::string as_lines(const RegisterBlock& now, const RegisterBlock& limits) {
  const auto fault = now.code<wire::Fault>(Id::fault);
  const double limit_V = limits.value(Id::voltage_limit_V);
  const double low_m = limits.value(Id::travel_low_m), high_m = limits.value(Id::travel_high_m);
  const auto line = [](std::string text) { return text + "\x1b[K\n"; };
  return line(fmt::format(
             "{:10.3f} s  {}{}", now.value(Id::time_s), wire::name(now.code<wire::State>(Id::state)),
             fault == wire::Fault::none ? std::string() : fmt::format("  {}", wire::words(fault)))) +
         line(fmt::format("position  {:+9.5f} m    {}", now.value(Id::live_position_m),
                          scale(now.value(Id::live_position_m), low_m, high_m))) +
         line(fmt::format("reference {:+9.5f} m    {}", now.value(Id::live_reference_m),
                          scale(now.value(Id::live_reference_m), low_m, high_m))) +
         line(fmt::format("voltage   {:+9.4f} V    {}", now.value(Id::live_voltage_V),
                          scale(now.value(Id::live_voltage_V), -limit_V, limit_V))) +
         line(fmt::format("speed     {:+9.4f} m/s  {} {:3.0f} %", now.value(Id::live_velocity_m_per_s),
                          wire::name(now.code<wire::ExperimentKind>(Id::experiment)),
                          100 * now.value(Id::progress)));
}

Outcome run(const device::Address& address, const Options& options) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto limits = controller->read(Id::voltage_limit_V, Id::travel_high_m);
  if (!limits) return conclude(limits.error());
  const bool redraw = ::isatty(STDOUT_FILENO) == 1;
  const Interrupt interrupt;
  for (bool first = true; !interrupt.requested(); first = false) {
    const auto now = controller->read(Id::state, Id::live_truth_velocity_m_per_s);
    if (!now) return conclude(now.error());
    if (options.json) {
      fmt::print("{}\n", as_json(*now));
    } else {
      if (redraw && !first) fmt::print("\x1b[{}A\r", kLines);  // up, over the lines before
      std::string lines = as_lines(*now, *limits);
      for (std::size_t at; !redraw && (at = lines.find("\x1b[K")) != std::string::npos;) lines.erase(at, 3);
      fmt::print("{}", lines);
    }
    if (std::fflush(stdout) != 0 || options.once) break;  // the reader of a pipe has gone
    std::this_thread::sleep_for(std::chrono::duration<double>(options.interval_s));
  }
  return Status::done;
}

}  // namespace

void add_device_watch(CLI::App& device, int& exit_status) {
  CLI::App* command = device.add_subcommand("watch", "Show live values until Ctrl-C");
  command->footer(
      "Reading does not disturb whoever commands.\n\n"
      "Examples:\n"
      "  cartwright device watch\n"
      "  cartwright device watch --once\n"
      "  cartwright device watch --json --interval 0.02 > live.jsonl");
  const auto address = add_address(command);
  auto options = std::make_shared<Options>();
  CLI::Range interval(0.001, 3600.0);
  interval.description("");
  command->add_option("--interval", options->interval_s, "seconds between looks, 0.001 to 3600")
      ->capture_default_str()
      ->check(interval);
  command->add_flag("--once", options->once, "look once");
  command->add_flag("--json", options->json, "one JSON object per line");
  on_run(command, exit_status, [address, options] { return run(*address, *options); });
}

}  // namespace cartwright::cli
