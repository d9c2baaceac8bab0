#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/session/import.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::vector<std::filesystem::path> files;
  std::string map, out;
};

Outcome run(const Options& options) {
  const auto map = read_import_map(options.map);
  if (!map) return tl::unexpected(map.error());
  const auto session = import_session(options.files, *map);
  if (!session) return tl::unexpected(session.error());
  const auto written = write_session(*session, options.out);
  if (!written) return tl::unexpected(written.error());
  for (const Recording& recording : session->recordings) {
    fmt::print("{}: {} rows over {:.6g} s at {:.6g} Hz\n", recording.file, recording.size(),
               recording.t_s.back() - recording.t_s.front(), session->rig.sample_rate_hz);
  }
  return Status::done;
}

}  // namespace

void add_import(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("import", "Turn MATLAB (.mat) or CSV files into a session");
  command->footer(
      "The map says which channel is what, in metres, volts and seconds:\n"
      "  [channels]\n"
      "  t_s = \"t\"\n"
      "  y_m = { channel = \"qm\", scale = 1.0, offset = 0.0 }\n"
      "  u_V = \"vir\"                               # a current or force command may stand here\n"
      "  r_m = { channel = \"data\", row = 2 }       # matrices: row or column; cell arrays: cell = [row, "
      "column]\n"
      "  [rig]                                     # as in session.toml, every key optional\n"
      "  encoder_resolution_m = 5e-8\n"
      "  [controller]                              # as in session.toml, optional\n"
      "Every file becomes one recording of the session. Example:\n"
      "  cartwright import DATA_EMPS.mat DATA_EMPS_PULSES.mat --map emps.toml --out emps");
  auto options = std::make_shared<Options>();
  command->add_option("files", options->files, "files to read (.mat version 4, 5 or 7.3, or CSV)")
      ->required();
  command->add_option("--map", options->map, "map of channels, units and signs (TOML)")->required();
  command->add_option("--out", options->out, "directory to write the session to")->required();
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
