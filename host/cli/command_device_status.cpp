#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/wire/model_registers.hpp"
#include "host/cli/device_command.hpp"

namespace cartwright::cli {
namespace {

using device::RegisterBlock;
using nlohmann::ordered_json;
using wire::Id;

void print_text(const RegisterBlock& rig, const RegisterBlock& now, const RegisterBlock& timing,
                const RegisterBlock& log, const RegisterBlock& online) {
  const auto state = now.code<wire::State>(Id::state);
  const auto line = [](std::string_view name, const std::string& value) {
    fmt::print("{:<13} {}\n", name, value);
  };
  line("rig",
       fmt::format("{}, {}{}, {} Hz", rig.text(Id::rig_name), rig.flag(Id::simulated) ? "simulated" : "real",
                   rig.flag(Id::virtual_time) ? " in virtual time" : "", rig.value(Id::rate_hz)));
  line("firmware", rig.text(Id::firmware_version));
  line("state", fmt::format("{}: {}", wire::name(state), wire::words(state)));
  if (const auto fault = now.code<wire::Fault>(Id::fault); fault != wire::Fault::none) {
    line("fault",
         fmt::format("{} ({}): {}", static_cast<int>(fault), wire::name(fault), now.text(Id::fault_text)));
  }
  if (const auto kind = now.code<wire::ExperimentKind>(Id::experiment); kind != wire::ExperimentKind::none) {
    const auto outcome = now.code<wire::Outcome>(Id::outcome);
    line("experiment",
         fmt::format("{}, run {} of {}, {:.0f} %, {}", wire::name(kind), now.value(Id::run_index),
                     now.value(Id::run_count), 100 * now.value(Id::progress), wire::words(outcome)));
  }
  line("position", fmt::format("{:.6f} m, travel {} to {} m", now.value(Id::live_position_m),
                               rig.value(Id::travel_low_m), rig.value(Id::travel_high_m)));
  line("voltage",
       fmt::format("{:.3f} V, limit {} V", now.value(Id::live_voltage_V), rig.value(Id::voltage_limit_V)));
  if (const std::string notice = online.text(Id::notice_text); !notice.empty()) line("notice", notice);
  line("compensation",
       fmt::format("{}", wire::kCompensationNames.at(online.integer<std::size_t>(Id::live_compensation))));
  line("clock", fmt::format("{} ticks, {:.3f} s, {} missed", now.value(Id::tick), now.value(Id::time_s),
                            now.value(Id::missed_ticks)));
  line("lateness",
       fmt::format("median {:.1f}, 99.9 % {:.1f}, greatest {:.1f} us", timing.value(Id::lateness_median_us),
                   timing.value(Id::lateness_p999_us), timing.value(Id::lateness_greatest_us)));
  line("step time",
       fmt::format("median {:.1f}, 99.9 % {:.1f}, greatest {:.1f} us", timing.value(Id::step_time_median_us),
                   timing.value(Id::step_time_p999_us), timing.value(Id::step_time_greatest_us)));
  line("log",
       fmt::format("{} recordings, {} rows of {} held, {} lost{}", log.value(Id::recording_count),
                   log.value(Id::log_rows) - log.value(Id::log_first_row), log.value(Id::log_capacity),
                   log.value(Id::log_lost_rows), log.flag(Id::log_frozen) ? ", frozen by the fault" : ""));
  const auto owner = now.integer<int>(Id::owner);
  line("commanded by", owner == 0 ? "nobody" : fmt::format("client {}", owner));
}

/// Every register of a block by its name; codes also in words.
void add_registers(ordered_json& into, const RegisterBlock& block, Id first, Id last) {
  for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
    const wire::Register& what = wire::registers()[i];
    if (what.type == wire::Type::text) {
      into[std::string(what.name)] = block.text(what.id);
    } else {
      const double value = block.value(what.id);
      into[std::string(what.name)] = std::isnan(value) ? ordered_json(nullptr) : ordered_json(value);
    }
  }
  const auto reword = [&](Id id, std::string_view word) {
    if (id >= first && id <= last) into[std::string(wire::info(id).name)] = word;
  };
  if (first <= Id::state && Id::outcome <= last) {
    reword(Id::state, wire::name(block.code<wire::State>(Id::state)));
    reword(Id::fault, wire::name(block.code<wire::Fault>(Id::fault)));
    reword(Id::limited_by, wire::name(block.code<wire::Limited>(Id::limited_by)));
    reword(Id::experiment, wire::name(block.code<wire::ExperimentKind>(Id::experiment)));
    reword(Id::outcome, wire::name(block.code<wire::Outcome>(Id::outcome)));
  }
}

Outcome run(const device::Address& address, bool json) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto rig = controller->read(Id::map_version, Id::most_missed_ticks);
  if (!rig) return conclude(rig.error());
  const auto now = controller->read(Id::state, Id::inputs);
  if (!now) return conclude(now.error());
  const auto timing = controller->read(Id::lateness_median_us, Id::step_time_greatest_us);
  if (!timing) return conclude(timing.error());
  const auto log = controller->read(Id::recording_count, Id::log_capacity);
  if (!log) return conclude(log.error());
  const auto online = controller->read(Id::live_compensation, Id::notice_text);
  if (!online) return conclude(online.error());
  if (!json) {
    print_text(*rig, *now, *timing, *log, *online);
    return Status::done;
  }
  ordered_json all;
  add_registers(all, *rig, Id::map_version, Id::most_missed_ticks);
  add_registers(all, *now, Id::state, Id::inputs);
  add_registers(all, *timing, Id::lateness_median_us, Id::step_time_greatest_us);
  add_registers(all, *log, Id::recording_count, Id::recording_count);
  add_registers(all, *log, Id::log_columns, Id::log_capacity);
  add_registers(all, *online, Id::live_compensation, Id::notice_text);
  all["notice"] = wire::name(online->code<wire::Notice>(Id::notice));
  fmt::print("{}\n", all.dump(2));
  return Status::done;
}

}  // namespace

void add_device_status(CLI::App& device, int& exit_status) {
  CLI::App* command =
      device.add_subcommand("status", "Show the state, faults, limits and timing of the controller");
  command->footer(
      "Examples:\n"
      "  cartwright device status\n"
      "  cartwright device status --json | jq .state");
  const auto address = add_address(command);
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON object, keys as in the register map");
  on_run(command, exit_status, [address, json] { return run(*address, *json); });
}

}  // namespace cartwright::cli
