#pragma once

#include <list>
#include <string>
#include <vector>

#include "host/cli/device_command.hpp"

namespace cartwright::cli {

/// The options of one kind of experiment, made from the register map: step_amplitude_m becomes --amplitude-m,
/// with the map's meaning, range and start value. What is not given gets the map's start value, so that a
/// command does the same whatever ran before it.
class ExperimentOptions {
 public:
  ExperimentOptions(CLI::App* command, wire::ExperimentKind kind);

  /// What to write before the command `run`.
  std::vector<device::Setting> settings() const;

 private:
  struct Entry {
    wire::Id id;
    double value;
    CLI::Option* option;
  };
  void add(CLI::App* command, const wire::Register& what, std::string_view prefix);

  wire::ExperimentKind kind_;
  std::list<Entry> entries_;  // CLI11 keeps references to the values
};

}  // namespace cartwright::cli
