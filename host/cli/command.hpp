#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/result.hpp"

namespace cartwright::cli {

/// Exit statuses of every command.
enum class Status {
  done = 0,
  no = 1,        ///< the answer is "no": a check failed
  unusable = 2,  ///< unusable input, said in one line on standard error
};

/// What a command gives back: a status, or what made its input unusable.
using Outcome = Result<Status>;

/// Registers `run` as what the subcommand does; its outcome becomes the program's exit status.
template <typename Run>
void on_run(CLI::App* command, int& exit_status, Run run) {
  command->callback([run = std::move(run), &exit_status] {
    const Outcome outcome = run();
    if (!outcome) std::fprintf(stderr, "cartwright: %s\n", outcome.error().message.c_str());
    exit_status = static_cast<int>(outcome.value_or(Status::unusable));
  });
}

// One function per command, each in a file of its own.
void add_completion(CLI::App& app, int& exit_status);
void add_design(CLI::App& app, int& exit_status);
void add_diagnose(CLI::App& app, int& exit_status);
void add_device(CLI::App& app, int& exit_status);
void add_doctor(CLI::App& app, int& exit_status);
void add_evaluate(CLI::App& app, int& exit_status);
void add_identify(CLI::App& app, int& exit_status);
void add_import(CLI::App& app, int& exit_status);
void add_export(CLI::App& app, int& exit_status);
void add_plot(CLI::App& app, int& exit_status);
void add_relay_identify(CLI::App& app, int& exit_status);
void add_report(CLI::App& app, int& exit_status);
void add_reproduce(CLI::App& app, int& exit_status);
void add_simulate(CLI::App& app, int& exit_status);
void add_sinefit(CLI::App& app, int& exit_status);

}  // namespace cartwright::cli
