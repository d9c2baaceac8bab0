#include <fmt/format.h>

#include <memory>

#include "common/files/files.hpp"
#include "host/cli/command.hpp"
#include "host/cli/design_options.hpp"
#include "host/cli/design_output.hpp"
#include "host/cli/progress.hpp"
#include "host/design/design_page.hpp"
#include "host/device/gain_file.hpp"

namespace cartwright::cli {
namespace {

/// Rules from the session given, or from relay tests simulated on the model; the ideal law has neither.
Result<design::RuleComparison> rules_for(const DesignOptions& options, const DesignTask& task) {
  if (options.ideal) return design::RuleComparison{};
  if (options.relay.empty()) {
    return design::compare_rules(task.trials, design::simulated_relay_session(task.model, task.trials.loop),
                                 true, task.integral);
  }
  const auto session = read_session(options.relay);
  if (!session) return tl::unexpected(session.error());
  return design::compare_rules(task.trials, *session, false, task.integral);
}

std::string gain_file_text(const DesignTask& task, const design::Gains& gains) {
  const design::Loop& loop = task.trials.loop;
  return device::gains_to_toml(
      {{gains.kp_V_per_m, gains.kd_V_s_per_m, loop.derivative_filter_hz, loop.derivative_on_measurement},
       gains.ki_V_per_m_s});
}

Outcome run(const DesignOptions& options, const CLI::App& command) {
  auto task = design_task(options, command);
  if (!task) return tl::unexpected(task.error());
  design::Design found;
  design::RuleComparison rules;
  {
    ProgressBar bar("mapping");
    task->search.progress = [&bar](std::string_view what, double share) {
      bar.label(std::string(what));
      bar.show(share);
    };
    auto compared = rules_for(options, *task);
    if (!compared) return tl::unexpected(compared.error());
    rules = std::move(*compared);
    found = design::search_gains(task->trials, task->search);
  }
  const std::string text = found.found && !options.ideal ? gain_file_text(*task, found.gains) : std::string();
  // The page first: without it there is no gain file either.
  if (!options.report.empty()) {
    const auto page = design::design_page({std::filesystem::path(options.model).filename().string(),
                                           task->rig_name, task->intervals, task->trials, task->search, found,
                                           rules, task->integral, text});
    if (const auto written = page.write(options.report); !written) return tl::unexpected(written.error());
  }
  if (!text.empty() && !options.out.empty()) {
    if (const auto written = write_file(options.out, text); !written) return tl::unexpected(written.error());
  }
  options.json ? print_json(*task, found, rules) : print_table(*task, found, rules);
  return found.found ? Status::done : Status::no;
}

}  // namespace

void add_design(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("design", "Find gains with which a model meets a specification");
  command->footer(
      "Tries gains all over the range with encoder, limit and filter as in the controller, on the\n"
      "model and on carts all over its intervals, and proposes those that keep a margin of every\n"
      "limit on all of them. Nothing is applied: the gain file is for `cartwright device gains flash`.\n"
      "Status 1: no gains meet it.\n"
      "Examples:\n"
      "  cartwright design --model model.toml --session rig/monday --settling-time 0.5 --out gains.toml\n"
      "  cartwright design --model model.toml --rig simulated.toml --rise-time 0.2 --report design.html\n"
      "  cartwright design --model model.toml --law pid --settling-time 0.8\n"
      "  cartwright design --model model.toml --ideal --kp 100 --settling-time 0.5 --settling-band 0.01");
  auto options = std::make_shared<DesignOptions>();
  add_design_options(*command, *options);
  on_run(command, exit_status, [options, command] { return run(*options, *command); });
}

}  // namespace cartwright::cli
