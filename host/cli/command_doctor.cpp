#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/doctor/check.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  bool json = false;
};

std::vector<Check> examine() {
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

Outcome run(const Options& options) {
  const std::vector<Check> checks = examine();
  const bool fine = std::none_of(checks.begin(), checks.end(),
                                 [](const Check& check) { return check.state == Check::State::wrong; });
  options.json ? print_json(checks, fine) : print_lines(checks);
  return fine ? Status::done : Status::no;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("doctor", "Check this machine for real-time control, and say what mends it");
  command->footer(
      "Status 0: nothing is wrong. Status 1: something is, and the line below it is the command that mends "
      "it.\n"
      "What is absent is only needed by some rigs.\n\n"
      "Examples:\n"
      "  cartwright doctor\n"
      "  cartwright doctor --json");
  auto options = std::make_shared<Options>();
  command->add_flag("--json", options->json, "print one JSON object");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
