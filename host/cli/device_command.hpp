#pragma once

#include <memory>

#include "host/cli/command.hpp"
#include "host/device/controller.hpp"

namespace cartwright::cli {

/// `--host` and `--port`, which every `cartwright device` command has.
std::shared_ptr<device::Address> add_address(CLI::App* command);

/// What a command gives back after trouble: "no" when the controller refused, else unusable.
Outcome conclude(const device::Trouble& trouble);

// The commands below `cartwright device`.
void add_device_status(CLI::App& device, int& exit_status);
void add_device_orders(CLI::App& device, int& exit_status);  ///< arm, disarm, stop, relearn, reset
void add_device_run(CLI::App& device, int& exit_status);
void add_device_gains(CLI::App& device, int& exit_status);
void add_device_pull(CLI::App& device, int& exit_status);
void add_device_compensation(CLI::App& device, int& exit_status);
void add_device_watch(CLI::App& device, int& exit_status);

}  // namespace cartwright::cli
