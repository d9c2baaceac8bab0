#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/report/pages/identification_page.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string truth, out = "report.html";
  std::vector<std::string> sessions, models;
};

/// "NAME=FILE" or "FILE", whose stem is then the name.
Result<report::NamedModel> read_named(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string file = equals == std::string::npos ? text : text.substr(equals + 1);
  const auto read = read_model_with_intervals(file);
  if (!read) return tl::unexpected(read.error());
  report::NamedModel out;
  out.name =
      equals == std::string::npos ? std::filesystem::path(file).stem().string() : text.substr(0, equals);
  out.model = read->model;
  out.intervals = read->intervals;
  return out;
}

std::string folder_name(const std::string& directory) {
  const std::filesystem::path path = std::filesystem::absolute(directory).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

/// Adds the recordings of one more session of the same rig; a name that is taken gets the directory's in
/// front.
Result<void> join(Session& all, Session more, const std::string& directory) {
  if (all.recordings.empty()) {
    all = std::move(more);
    return {};
  }
  if (more.rig.sample_rate_hz != all.rig.sample_rate_hz ||
      more.rig.voltage_limit_V != all.rig.voltage_limit_V ||
      more.rig.encoder_resolution_m != all.rig.encoder_resolution_m) {
    return failure(directory +
                   ": another rig (sample rate, voltage limit or encoder differ); give sessions of one rig");
  }
  const std::string folder = folder_name(directory);
  for (Recording& recording : more.recordings) {
    recording.file = folder + "/" + recording.file;
    if (!recording.repeat_of.empty()) recording.repeat_of = folder + "/" + recording.repeat_of;
    all.recordings.push_back(std::move(recording));
  }
  return {};
}

Outcome run(const Options& options) {
  report::IdentificationPage content;
  for (const std::string& directory : options.sessions) {
    auto session = read_session(directory);
    if (!session) return tl::unexpected(session.error());
    const auto joined = join(content.session, std::move(*session), directory);
    if (!joined) return tl::unexpected(joined.error());
    content.source += (content.source.empty() ? "" : ", ") + folder_name(directory);
  }
  for (const std::string& text : options.models) {
    auto model = read_named(text);
    if (!model) return tl::unexpected(model.error());
    content.models.push_back(std::move(*model));
  }
  if (!options.truth.empty()) {
    auto truth = read_model(options.truth);
    if (!truth) return tl::unexpected(truth.error());
    content.truth = std::move(*truth);
  }
  const auto written = report::identification_page(content).write(options.out);
  if (!written) return tl::unexpected(written.error());
  std::printf("%s\n", options.out.c_str());
  return Status::done;
}

}  // namespace

void add_report(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("report", "Identify a session and show everything in one HTML page");
  command->footer(
      "Examples:\n"
      "  cartwright report rig/monday --out monday.html\n"
      "  cartwright report rig/monday rig/monday-gains --out monday.html\n"
      "  cartwright report rig/monday --model yesterday=sunday.toml --truth cart.toml\n"
      "Identifies from one step, from the relay tests and, unless --model gives models of all recordings,\n"
      "from the recorded voltage: viscous and Coulomb friction and a constant force. Models given here are\n"
      "shown beside those; --truth, what a simulated cart was made of, stands in the tables as the true "
      "value.");
  auto options = std::make_shared<Options>();
  command->add_option("session,--session", options->sessions, "directories with session.toml, of one rig")
      ->required();
  command->add_option("--model", options->models,
                      "further model to compare, FILE or NAME=FILE; may be repeated");
  command->add_option("--truth", options->truth, "model file of what a simulated cart really is");
  command->add_option("--out", options->out, "page to write")->capture_default_str();
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
