#include <fmt/format.h>

#include <cstdio>

#include "host/cli/device_command.hpp"

namespace cartwright::cli {

std::shared_ptr<device::Address> add_address(CLI::App* command) {
  auto address = std::make_shared<device::Address>();
  command->add_option("--host", address->host, "where cartwrightd listens")->capture_default_str();
  command->add_option("--port", address->port, "its port")
      ->capture_default_str()
      ->check(CLI::Range(1, 65535));
  return address;
}

Outcome conclude(const device::Trouble& trouble) {
  if (trouble.cause != device::Cause::refused) return failure(trouble.message);
  fmt::print(stderr, "cartwright: {}\n", trouble.message);
  return Status::no;
}

namespace {

/// Arm, disarm, stop, relearn and reset are one word to the controller each.
struct Order {
  const char* name;
  const char* help;
  wire::Command command;
  const char* done;
};

constexpr Order kOrders[] = {
    {"arm", "Switch the amplifier on, at zero volts", wire::Command::arm, "armed"},
    {"disarm", "Switch the amplifier off", wire::Command::disarm, "disarmed"},
    {"stop", "End the running experiment; the controller stays armed", wire::Command::stop, "stopped"},
    {"relearn", "Forget what was identified while running, and let go of its notice",
     wire::Command::restart_identification, "forgotten"},
    {"reset", "Leave the faulted state, once the cause is gone", wire::Command::reset, "disarmed"},
};

Outcome give(const device::Address& address, const Order& order) {
  auto controller = device::Controller::connect(address);
  if (!controller) return conclude(controller.error());
  if (const auto given = controller->command(order.command); !given) return conclude(given.error());
  fmt::print("{}\n", order.done);
  return Status::done;
}

}  // namespace

void add_device_orders(CLI::App& device, int& exit_status) {
  for (const Order& order : kOrders) {
    CLI::App* command = device.add_subcommand(order.name, order.help);
    command->footer(fmt::format(
        "Status 1: the controller refused, and says why.\n\nExample:\n  cartwright device {}", order.name));
    const auto address = add_address(command);
    on_run(command, exit_status, [address, &order] { return give(*address, order); });
  }
}

void add_device(CLI::App& app, int& exit_status) {
  CLI::App* device =
      app.add_subcommand("device", "Talk to a controller: run experiments, fetch logs, change gains");
  device->footer(
      "Examples:\n"
      "  cartwright device status\n"
      "  cartwright device run battery --out rig/monday\n"
      "  cartwright device gains flash gains.toml --host 192.168.1.20\n"
      "  cartwright device compensation feedforward --model model.toml\n"
      "  cartwright device watch");
  device->require_subcommand(1);
  add_device_status(*device, exit_status);
  add_device_orders(*device, exit_status);
  add_device_run(*device, exit_status);
  add_device_gains(*device, exit_status);
  add_device_compensation(*device, exit_status);
  add_device_pull(*device, exit_status);
  add_device_watch(*device, exit_status);
}

}  // namespace cartwright::cli
