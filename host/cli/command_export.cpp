#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "host/cli/command.hpp"
#include "host/export/matlab.hpp"
#include "host/export/ulog.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string session, to, out;
};

Result<std::vector<NamedText>> convert(const Session& session, const std::string& format) {
  std::vector<NamedText> files;
  if (format == "mat") {
    auto bytes = to_matlab(session);
    if (!bytes) return tl::unexpected(bytes.error());
    files.push_back({"session.mat", std::move(*bytes)});
    return files;
  }
  std::set<std::string> taken;
  for (const Recording& recording : session.recordings) {
    auto bytes = to_ulog(session.rig, recording);
    if (!bytes) return tl::unexpected(bytes.error());
    std::string name = fs::path(recording.file).replace_extension(".ulg").string();
    if (!taken.insert(name).second) name = recording.file + ".ulg";  // a.csv and a.txt
    files.push_back({std::move(name), std::move(*bytes)});
  }
  return files;
}

Outcome run(const Options& options) {
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  const fs::path directory = options.out.empty() ? options.session : options.out;
  const auto files = convert(*session, options.to);
  if (!files) return tl::unexpected(files.error());
  const auto written = write_files(directory, *files);
  if (!written) return tl::unexpected(written.error());
  for (const NamedText& file : *files) fmt::print("{}\n", (directory / file.name).string());
  return Status::done;
}

}  // namespace

void add_export(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("export", "Write a session as MATLAB or ULog files");
  command->footer(
      "mat: one session.mat (MATLAB version 5; MATLAB load, scipy.io.loadmat), a struct per recording.\n"
      "ulg: one ULog file per recording (PlotJuggler, Foxglove), gains as a topic, losses as dropouts.\n\n"
      "Examples:\n"
      "  cartwright export rig/monday --to mat\n"
      "  cartwright export rig/monday --to ulg --out for-plotjuggler");
  auto options = std::make_shared<Options>();
  command->add_option("SESSION", options->session, "directory with session.toml")->required();
  command->add_option("--to", options->to, "format: mat or ulg")
      ->required()
      ->check(CLI::IsMember({"mat", "ulg"}));
  command->add_option("--out", options->out, "directory to write to (default: the session's own)");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
