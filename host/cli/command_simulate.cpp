#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/gap_note.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string model, session, out;
};

Outcome run(const Options& options) {
  const auto model = read_model(options.model);
  if (!model) return tl::unexpected(model.error());
  auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  tell_gaps(*session);
  const std::size_t foreign = session->without_law();
  if (foreign > 0)
    fmt::print(
        stderr,
        "cartwright: note: {} of {} recordings come without a control law: their voltage is replayed\n",
        foreign, session->recordings.size());
  for (Recording& recording : session->recordings) recording = simulate(*model, session->rig, recording);
  const auto written = write_session(*session, options.out);
  if (!written) return tl::unexpected(written.error());
  return Status::done;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("simulate", "Re-run each recording's controller and reference on a model");
  command->footer(
      "Example:\n"
      "  cartwright simulate --model nominal.toml --session rig/monday --out rig/monday-simulated");
  auto options = std::make_shared<Options>();
  command->add_option("--model", options->model, "model file (TOML)")->required();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_option("--out", options->out, "directory to write the simulated session to")->required();
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
