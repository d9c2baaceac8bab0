#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/device_command.hpp"
#include "host/doctor/check.hpp"

namespace cartwright::cli {
namespace {

Check check_controller(const device::Address& address) {
  const auto controller = device::Controller::connect(address);
  if (controller) return {"controller", Check::State::fine, "cartwrightd answers at " + address.text(), ""};
  return {"controller", Check::State::wrong, controller.error().message, "sudo systemctl start cartwrightd"};
}

std::vector<Check> examine(const device::Address& address) {
  const SystemView system;
  const Permissions allowed = permissions();
  std::vector<Check> checks = {
      check_kernel(system),         check_priority(allowed),
      check_locked_memory(allowed), check_clock_resolution(allowed),
      check_clock_source(system),   check_sleep_states(system),
      check_governor(system),
  };
  for (Check& can : check_can(system)) checks.push_back(std::move(can));
  checks.push_back(check_gpio(system));
  checks.push_back(check_controller(address));
  return checks;
}

std::string_view word(Check::State state) {
  switch (state) {
    case Check::State::fine:
      return "fine";
    case Check::State::absent:
      return "absent";
    case Check::State::wrong:
      return "wrong";
  }
  return "";
}

void print_lines(const std::vector<Check>& checks) {
  for (const Check& check : checks) {
    fmt::print("{:<7} {:<19} {}\n", word(check.state), check.name, check.found);
    if (!check.mend.empty()) fmt::print("{:<27} mend: {}\n", "", check.mend);
  }
}

void print_json(const std::vector<Check>& checks, bool fine) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    nlohmann::ordered_json entry = {
        {"name", check.name}, {"state", word(check.state)}, {"found", check.found}};
    entry["mend"] = check.mend.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(check.mend);
    list.push_back(std::move(entry));
  }
  fmt::print("{}\n", nlohmann::ordered_json{{"fine", fine}, {"checks", std::move(list)}}.dump(2));
}

Outcome run(const device::Address& address, bool json) {
  const std::vector<Check> checks = examine(address);
  const bool fine = std::none_of(checks.begin(), checks.end(),
                                 [](const Check& check) { return check.state == Check::State::wrong; });
  json ? print_json(checks, fine) : print_lines(checks);
  return fine ? Status::done : Status::no;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("doctor", "Check this machine for real-time control, and say what mends it");
  command->footer(
      "Status 0: nothing is wrong. Status 1: something is, and the line below it is the command\n"
      "that mends it. What is absent is only needed by some rigs.\n\n"
      "Examples:\n"
      "  cartwright doctor\n"
      "  cartwright doctor --json");
  const auto address = add_address(command);
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON object");
  on_run(command, exit_status, [address, json] { return run(*address, *json); });
}

}  // namespace cartwright::cli
