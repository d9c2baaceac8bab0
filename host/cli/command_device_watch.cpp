#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/wire/model_registers.hpp"
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

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// What is identified while running, each with its interval.
struct Identified {
  const char* name;
  const char* label;
  const char* unit;
  Id value;
};
constexpr Identified kIdentified[] = {
    {"voltage_gain_m_per_s2_V", "gain", "m/s^2/V", Id::identified_gain_m_per_s2_V},
    {"viscous_friction.coefficient_per_s", "viscous", "1/s", Id::identified_viscous_per_s},
    {"coulomb_friction.level_m_per_s2", "Coulomb", "m/s^2", Id::identified_coulomb_m_per_s2},
};
Id after(Id id, std::size_t places) {
  return static_cast<Id>(static_cast<std::size_t>(id) + places);
}

void add_online(ordered_json& line, const RegisterBlock& online) {
  line["compensation"] = wire::kCompensationNames.at(online.integer<std::size_t>(Id::live_compensation));
  line["compensation_V"] = number(online.value(Id::live_compensation_V));
  for (const Identified& each : kIdentified) {
    line["identified"][each.name] = {{"value", number(online.value(each.value))},
                                     {"low", number(online.value(after(each.value, 1)))},
                                     {"high", number(online.value(after(each.value, 2)))}};
  }
  line["innovation_m_per_s2"] = number(online.value(Id::innovation_m_per_s2));
  line["notice"] = wire::name(online.code<wire::Notice>(Id::notice));
  line["notice_text"] = online.text(Id::notice_text);
}

std::string as_json(const RegisterBlock& now, const RegisterBlock& online) {
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
  add_online(line, online);
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

std::string online_lines(const RegisterBlock& online) {
  std::string out;
  const auto line = [&out](const std::string& text) { out += text + "\x1b[K\n"; };
  line(fmt::format("friction  {:+9.4f} V    compensation {}", online.value(Id::live_compensation_V),
                   wire::kCompensationNames.at(online.integer<std::size_t>(Id::live_compensation))));
  for (const Identified& each : kIdentified) {
    const double value = online.value(each.value);
    line(std::isfinite(value)
             ? fmt::format("{:<9} {:9.5g} {:<8} [{:.5g}, {:.5g}]", each.label, value, each.unit,
                           online.value(after(each.value, 1)), online.value(after(each.value, 2)))
             : fmt::format("{:<9} not yet known", each.label));
  }
  const std::string notice = online.text(Id::notice_text);
  const double innovation = online.value(Id::innovation_m_per_s2);
  line(!notice.empty()             ? "notice    " + notice
       : std::isfinite(innovation) ? fmt::format("model     {:.3g} m/s^2 unexplained, limit {:.3g}",
                                                 innovation, online.value(Id::innovation_limit_m_per_s2))
                                   : std::string("model     nothing to judge by yet"));
  return out;
}

/// The same number of lines every time, so that they can be drawn over.
constexpr int kLines = 10;
std::string as_lines(const RegisterBlock& now, const RegisterBlock& limits, const RegisterBlock& online) {
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
                          100 * now.value(Id::progress))) +
         online_lines(online);
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
    const auto online = controller->read(Id::live_compensation, Id::notice_text);
    if (!online) return conclude(online.error());
    if (options.json) {
      fmt::print("{}\n", as_json(*now, *online));
    } else {
      if (redraw && !first) fmt::print("\x1b[{}A\r", kLines);  // up, over the lines before
      std::string lines = as_lines(*now, *limits, *online);
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
