#include <fmt/format.h>

#include <memory>

#include "common/files/files.hpp"
#include "host/cli/command.hpp"
#include "host/cli/design_options.hpp"
#include "host/cli/design_output.hpp"
#include "host/cli/progress.hpp"
#include "host/device/gain_file.hpp"

namespace cartwright::cli {
namespace {

Outcome run(const DesignOptions& options, const CLI::App& command) {
  auto task = design_task(options, command);
  if (!task) return tl::unexpected(task.error());
  design::Design found;
  {
    ProgressBar bar("mapping");
    task->search.progress = [&bar](std::string_view what, double share) {
      bar.label(std::string(what));
      bar.show(share);
    };
    found = design::search_gains(task->trials, task->search);
  }
  if (found.found && !options.out.empty()) {
    const design::Loop& loop = task->trials.loop;
    const auto written = write_file(
        options.out, device::gains_to_toml({found.gains.kp_V_per_m, found.gains.kd_V_s_per_m,
                                            loop.derivative_filter_hz, loop.derivative_on_measurement}));
    if (!written) return tl::unexpected(written.error());
  }
  options.json ? print_json(*task, found) : print_table(*task, found);
  return found.found ? Status::done : Status::no;
}

}  // namespace

void add_design(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("design", "Find gains with which a model meets a specification");
  command->footer(
      "Tries gains all over the range with encoder, limit and filter as in the controller, on the model and "
      "on carts\n"
      "all over its intervals, and proposes those that keep a margin of every limit on all of them. Nothing "
      "is applied:\n"
      "the gain file is for `cartwright device gains flash`. Status 1: no gains meet it.\n"
      "Examples:\n"
      "  cartwright design --model model.toml --session rig/monday --settling-time 0.5 --overshoot 0.05 "
      "--out gains.toml\n"
      "  cartwright design --model model.toml --rig rig.toml --rise-time 0.2 --rms-voltage 2 --report "
      "design.html\n"
      "  cartwright design --model model.toml --law pid --settling-time 0.8\n"
      "  cartwright design --model lm3.toml --ideal --kp 100 --settling-time 0.5 --settling-band 0.01");
  auto options = std::make_shared<DesignOptions>();
  add_design_options(*command, *options);
  on_run(command, exit_status, [options, command] { return run(*options, *command); });
}

}  // namespace cartwright::cli
