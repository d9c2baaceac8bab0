#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/session/even_rows.hpp"
#include "host/session/import.hpp"
#include "host/session/join.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::vector<std::filesystem::path> files;
  std::string map, out;
};

/// Says what was done about rows that do not follow each other evenly.
std::string spacing_in_words(const Recording& recording, const ImportMap& map) {
  const RowSpacing spacing = row_spacing(recording.t_s);
  std::string words;
  if (map.resample_hz) {
    words = ", put onto an even grid";
  } else if (!spacing.even()) {
    words = fmt::format(", unevenly {:.4g} to {:.4g} ms apart: kept with their own times",
                        1e3 * spacing.least_s, 1e3 * spacing.most_s);
  }
  if (spacing.gaps > 0) words += fmt::format(", with {} gap{}", spacing.gaps, spacing.gaps == 1 ? "" : "s");
  return words;
}

/// A session that stands there already grows; nothing of it is lost.
Result<Session> with_what_is_there(const Session& imported, const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory / "session.toml")) return imported;
  auto before = read_session(directory);
  if (!before) return before;
  auto whole = joined(std::move(*before), imported);
  if (!whole) return failure(fmt::format("{}: {}", directory.string(), whole.error().message));
  return whole;
}

Outcome run(const Options& options) {
  const auto map = read_import_map(options.map);
  if (!map) return tl::unexpected(map.error());
  const auto session = import_session(options.files, *map);
  if (!session) return tl::unexpected(session.error());
  const auto whole = with_what_is_there(*session, options.out);
  if (!whole) return tl::unexpected(whole.error());
  const auto written = write_session(*whole, options.out);
  if (!written) return tl::unexpected(written.error());
  for (const Recording& recording : session->recordings) {
    fmt::print("{}: {} rows over {:.6g} s at {:.6g} Hz{}\n", recording.file, recording.size(),
               recording.t_s.back() - recording.t_s.front(), session->rig.sample_rate_hz,
               spacing_in_words(recording, *map));
  }
  if (whole->recordings.size() > session->recordings.size()) {
    fmt::print("{} now holds {} recordings\n", options.out, whole->recordings.size());
  }
  return Status::done;
}

}  // namespace

void add_import(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("import", "Turn MATLAB (.mat), CSV or JSON files into a session");
  command->footer(
      "The map says which channel is what, in metres, volts and seconds:\n"
      "  [channels]\n"
      "  t_s = \"t\"\n"
      "  y_m = { channel = \"qm\", scale = 1.0, offset = 0.0 }\n"
      "  u_V = \"vir\"                               # a current or force command may stand here\n"
      "  # duty times supply, from a register of 16 bits with a sign:\n"
      "  u_V = { channel = \"load\", signed_bits = 16, times = \"supply\", scale = 1.13e-3 }\n"
      "  r_m = { channel = \"data\", row = 2 }       # of a matrix; or column = 2, or cell = [row, column]\n"
      "  [recording]                               # every key optional\n"
      "  experiment = \"track\"\n"
      "  rows = \"entries\"                          # JSON: which array holds the rows, an object each\n"
      "  resample_hz = 400                         # put uneven rows onto an even grid; gaps stay gaps\n"
      "  cell_columns = [2, 4]                     # a recording of each, for channels with cell_row = N\n"
      "  [rig]                                     # as in session.toml, every key optional\n"
      "  encoder_resolution_m = 5e-8\n"
      "  [controller]                              # as in session.toml, optional\n"
      "One radian or one revolution of a rotary rig stands for one metre. Every file becomes a recording of\n"
      "the session; imported into a session that is there already, they are added to it. Rows keep their "
      "own\n"
      "times unless resample_hz is given; what lies unevenly is said.\n"
      "Example:\n"
      "  cartwright import DATA_EMPS.mat DATA_EMPS_PULSES.mat --map emps.toml --out emps");
  auto options = std::make_shared<Options>();
  command->add_option("files", options->files, "files to read (.mat version 4, 5 or 7.3, CSV, or JSON)")
      ->required();
  command->add_option("--map", options->map, "map of channels, units and signs (TOML)")->required();
  command->add_option("--out", options->out, "directory of the session, new or to be added to")->required();
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
