#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "host/cli/device_command.hpp"
#include "host/device/gain_file.hpp"

namespace cartwright::cli {
namespace {

using device::RegisterBlock;
using nlohmann::ordered_json;
using wire::Id;

/// Gains from the register `kp` and the four after it.
PidGains gains_at(const RegisterBlock& block, Id kp) {
  const auto next = [kp](std::size_t offset) {
    return static_cast<Id>(static_cast<std::size_t>(kp) + offset);
  };
  return {{block.value(kp), block.value(next(1)), block.value(next(2)), block.flag(next(3))},
          block.value(next(4))};
}

ordered_json to_json(const PidGains& gains) {
  const bool pid = gains.ki_V_per_m_s != 0;
  ordered_json out = {{"type", pid ? "pid" : "pd"}, {"kp_V_per_m", gains.pd.kp_V_per_m}};
  if (pid) out["ki_V_per_m_s"] = gains.ki_V_per_m_s;
  out["kd_V_s_per_m"] = gains.pd.kd_V_s_per_m;
  out["derivative_filter_hz"] = gains.pd.derivative_filter_hz;
  out["derivative_on"] = gains.pd.derivative_on_measurement ? "measurement" : "error";
  return out;
}

std::string integral_text(const PidGains& gains) {
  return gains.ki_V_per_m_s == 0 ? std::string() : fmt::format("ki {} V/(m s), ", gains.ki_V_per_m_s);
}

struct Slot {
  Id valid, generation, kp;
};
constexpr Slot kSlots[] = {{Id::slot1_valid, Id::slot1_generation, Id::slot1_kp_V_per_m},
                           {Id::slot2_valid, Id::slot2_generation, Id::slot2_kp_V_per_m}};

void print_json(const RegisterBlock& block) {
  ordered_json slots = ordered_json::array();
  for (const Slot& slot : kSlots) {
    ordered_json entry = {{"valid", block.flag(slot.valid)}};
    entry["generation"] = block.value(slot.generation);
    entry["controller"] = block.flag(slot.valid) ? to_json(gains_at(block, slot.kp)) : ordered_json(nullptr);
    slots.push_back(std::move(entry));
  }
  const ordered_json all = {{"slot", block.integer<int>(Id::gain_slot)},
                            {"controller", to_json(gains_at(block, Id::active_kp_V_per_m))},
                            {"slots", std::move(slots)}};
  fmt::print("{}\n", all.dump(2));
}

Outcome get(const device::Address& address, bool json) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto block = controller->read(Id::gain_slot, Id::slot2_ki_V_per_m_s);
  if (!block) return conclude(block.error());
  if (json) {
    print_json(*block);
    return Status::done;
  }
  const int active = block->integer<int>(Id::gain_slot);
  fmt::print("# Active: {}.\n{}",
             active == 0 ? std::string("built-in gains") : fmt::format("slot {}", active),
             device::gains_to_toml(gains_at(*block, Id::active_kp_V_per_m)));
  for (int i = 0; i < 2; ++i) {
    const PidGains gains = gains_at(*block, kSlots[i].kp);
    if (!block->flag(kSlots[i].valid)) {
      fmt::print("# Slot {}: no valid gains.\n", i + 1);
    } else {
      fmt::print("# Slot {}: generation {}, kp {} V/m, {}kd {} V s/m, filter {} Hz.\n", i + 1,
                 block->value(kSlots[i].generation), gains.pd.kp_V_per_m, integral_text(gains),
                 gains.pd.kd_V_s_per_m, gains.pd.derivative_filter_hz);
    }
  }
  return Status::done;
}

Outcome flash(const device::Address& address, const std::string& file) {
  const auto gains = device::read_gains(file);
  if (!gains) return tl::unexpected(gains.error());
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto staged =
      controller->write({{Id::staged_kp_V_per_m, gains->pd.kp_V_per_m},
                         {Id::staged_kd_V_s_per_m, gains->pd.kd_V_s_per_m},
                         {Id::staged_filter_hz, gains->pd.derivative_filter_hz},
                         {Id::staged_derivative_on_measurement, gains->pd.derivative_on_measurement},
                         {Id::staged_ki_V_per_m_s, gains->ki_V_per_m_s}});
  if (!staged) return conclude(staged.error());
  if (const auto stored = controller->command(wire::Command::store_gains); !stored)
    return conclude(stored.error());
  const auto block = controller->read(Id::gain_slot, Id::active_ki_V_per_m_s);
  if (!block) return conclude(block.error());
  const PidGains active = gains_at(*block, Id::active_kp_V_per_m);
  fmt::print("slot {} is active: kp {} V/m, {}kd {} V s/m, filter {} Hz, derivative on {}\n",
             block->value(Id::gain_slot), active.pd.kp_V_per_m, integral_text(active), active.pd.kd_V_s_per_m,
             active.pd.derivative_filter_hz, active.pd.derivative_on_measurement ? "measurement" : "error");
  return Status::done;
}

Outcome activate(const device::Address& address, unsigned slot) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  const auto done = controller->command(wire::Command::activate_gains, static_cast<std::uint16_t>(slot));
  if (!done) return conclude(done.error());
  fmt::print("slot {} is active\n", slot);
  return Status::done;
}

}  // namespace

void add_device_gains(CLI::App& device, int& exit_status) {
  CLI::App* gains = device.add_subcommand("gains", "Show or change the controller's gains");
  gains->require_subcommand(1);
  gains->footer(
      "A gain file has one table, [controller], with the keys of a controller in session.toml.\n\n"
      "Examples:\n"
      "  cartwright device gains get > gains.toml\n"
      "  cartwright device gains flash gains.toml\n"
      "  cartwright device gains activate 1");

  CLI::App* get_command =
      gains->add_subcommand("get", "Print the active gains as a gain file, and both slots");
  get_command->footer("Example:\n  cartwright device gains get > gains.toml");
  const auto get_address = add_address(get_command);
  auto json = std::make_shared<bool>(false);
  get_command->add_flag("--json", *json, "print one JSON object");
  on_run(get_command, exit_status, [get_address, json] { return get(*get_address, *json); });

  CLI::App* flash_command =
      gains->add_subcommand("flash", "Store a gain file in the inactive slot and use it");
  flash_command->footer(
      "The gains change between two ticks, without a bump, also while an experiment runs.\n\n"
      "Example:\n  cartwright device gains flash gains.toml");
  const auto flash_address = add_address(flash_command);
  auto file = std::make_shared<std::string>();
  flash_command->add_option("FILE", *file, "gain file (TOML)")->required();
  on_run(flash_command, exit_status, [flash_address, file] { return flash(*flash_address, *file); });

  CLI::App* activate_command = gains->add_subcommand("activate", "Go back to what the other slot holds");
  activate_command->footer("Example:\n  cartwright device gains activate 1");
  const auto activate_address = add_address(activate_command);
  auto slot = std::make_shared<unsigned>(1);
  activate_command->add_option("SLOT", *slot, "1 or 2")->required()->check(CLI::IsMember({"1", "2"}));
  on_run(activate_command, exit_status,
         [activate_address, slot] { return activate(*activate_address, *slot); });
}

}  // namespace cartwright::cli
