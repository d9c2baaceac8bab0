#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "host/cli/command.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/replay.hpp"
#include "host/report/session_page.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string session, model, out;
};

struct Predicted {
  std::string how;
  double rms_error_m = 0;
  report::Overlay overlay;
};

/// The closed loop where the control law is known, else the recorded voltage from the start: the same numbers
/// as `cartwright evaluate` gives.
Predicted predicted_by(const Model& model, const Rig& rig, const Recording& recording) {
  Predicted out;
  out.overlay = {"model", report::Colour::model, recording.t_s, {}, {}};
  if (recording.has_controller()) {
    Recording again = simulate(model, rig, recording);
    out.how = "driven by the recorded reference through the same controller";
    out.rms_error_m = squared_error(again.y_m, recording.y_m).rms_m();
    out.overlay.y_m = std::move(again.y_m);
    out.overlay.u_V = std::move(again.u_V);
  } else {
    out.how = "driven by the recorded voltage, its start taken from the first 20 rows";
    out.overlay.y_m = replay_open_loop(model, recording);
    out.rms_error_m = open_loop_error(out.overlay.y_m, recording).rms_m();
  }
  return out;
}

Outcome run(const Options& options) {
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  std::optional<Model> model;
  if (!options.model.empty()) {
    auto read = read_model(options.model);
    if (!read) return tl::unexpected(read.error());
    model = *read;
  }
  const std::filesystem::path folder = std::filesystem::absolute(options.session).lexically_normal();
  const std::string name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  report::Report page{"Recordings of " + session->rig.name, name};
  page.facts(
      {{"Rig", session->rig.name},
       {"Sample rate", fmt::format("{} Hz", session->rig.sample_rate_hz)},
       {"Encoder", fmt::format("{:.4g} µm per count", 1e6 * session->rig.encoder_resolution_m)},
       {"Voltage limit", fmt::format("±{:.4g} V", session->rig.voltage_limit_V)},
       {"Travel", fmt::format("{} to {} mm", report::format_number(1e3 * session->rig.travel_m[0], 3),
                              report::format_number(1e3 * session->rig.travel_m[1], 3))},
       {"Recordings", std::to_string(session->recordings.size())},
       {"Model", options.model.empty() ? "none" : std::filesystem::path(options.model).filename().string()},
       {"Made by", "cartwright " CARTWRIGHT_VERSION}});
  page.table(report::recordings_table(*session));
  for (const Recording& recording : session->recordings) {
    page.section(recording.file);
    std::string line = (recording.experiment.empty() ? "" : recording.experiment + "; ") +
                       report::describe_fully(recording.controller) + ".";
    std::vector<report::Overlay> overlays;
    if (model) {
      Predicted predicted = predicted_by(*model, session->rig, recording);
      line +=
          fmt::format(" The model, {}, is {:.4g} mm rms away.", predicted.how, 1e3 * predicted.rms_error_m);
      overlays.push_back(std::move(predicted.overlay));
    }
    page.paragraph(line);
    std::vector<report::Plot> plots = report::recording_plots(recording, overlays);
    plots.front().title.clear();
    for (const report::Plot& plot : plots) page.plot(plot);
  }
  const std::filesystem::path out = options.out.empty() ? name + ".html" : options.out;
  const auto written = page.write(out);
  if (!written) return tl::unexpected(written.error());
  std::printf("%s\n", out.c_str());
  return Status::done;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("plot", "Draw the recordings of a session into one HTML page");
  command->footer(
      "Examples:\n"
      "  cartwright plot rig/monday\n"
      "  cartwright plot rig/monday --model nominal.toml --out monday.html\n"
      "With a model, its prediction is drawn over every recording. The page needs no other file;\n"
      "drag in a plot to zoom, double-click to see everything again.");
  auto options = std::make_shared<Options>();
  command->add_option("session,--session", options->session, "directory with session.toml")->required();
  command->add_option("--model", options->model, "model file (TOML) to draw over the recordings");
  command->add_option("--out", options->out, "page to write (default: the session's name with .html)");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
