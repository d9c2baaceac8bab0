#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/cli/gap_note.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string model, session, out;
  bool json = false;
};

struct Totals {
  SquaredError closed_loop, window, open_loop;
};

ordered_json number(const SquaredError& error) {
  return error.rows == 0 ? ordered_json(nullptr) : ordered_json(error.rms_m());
}

void add_errors(ordered_json& entry, const SquaredError& closed_loop, const SquaredError& window,
                const SquaredError& open_loop) {
  entry["closed_loop_rmse_m"] = number(closed_loop);
  entry["window_rmse_m"] = number(window);
  entry["open_loop_rmse_m"] = number(open_loop);
}

std::string cell(const SquaredError& error) {
  return error.rows == 0 ? "-" : fmt::format("{:.4f}", 1e3 * error.rms_m());
}

void print_row(const std::string& name, const SquaredError& closed_loop, const SquaredError& window,
               const SquaredError& open_loop) {
  fmt::print("{:<28} {:>12} {:>12} {:>12}\n", name, cell(closed_loop), cell(window), cell(open_loop));
}

/// Recordings that differ only by their extension keep it.
std::string prediction_file(const Session& session, const Recording& recording) {
  const auto stem = [](const Recording& r) { return std::filesystem::path(r.file).stem(); };
  const auto alike = std::count_if(session.recordings.begin(), session.recordings.end(),
                                   [&](const Recording& other) { return stem(other) == stem(recording); });
  return (alike > 1 ? recording.file : stem(recording).string()) + ".prediction.csv";
}

Outcome run(const Options& options) {
  const auto model = read_model(options.model);
  if (!model) return tl::unexpected(model.error());
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  tell_gaps(*session);

  std::vector<Prediction> predictions;
  std::vector<NamedText> files;
  Totals all;
  for (const Recording& recording : session->recordings) {
    predictions.push_back(predict(*model, session->rig, recording));
    const Prediction& prediction = predictions.back();
    all.closed_loop.add(prediction.closed_loop);
    all.window.add(prediction.window);
    all.open_loop.add(prediction.open_loop);
    files.push_back({prediction_file(*session, recording), to_csv(to_table(prediction, recording))});
  }
  const auto written = write_files(options.out, files);
  if (!written) return tl::unexpected(written.error());

  if (options.json) {
    ordered_json document;
    document["recordings"] = ordered_json::array();
    for (const Prediction& prediction : predictions) {
      ordered_json entry{{"file", prediction.file}};
      add_errors(entry, prediction.closed_loop, prediction.window, prediction.open_loop);
      document["recordings"].push_back(std::move(entry));
    }
    add_errors(document, all.closed_loop, all.window, all.open_loop);
    fmt::print("{}\n", document.dump(2));
    return Status::done;
  }
  fmt::print("{:<28} {:>12} {:>12} {:>12}\n", "rms error [mm]", "closed loop", "windows", "open loop");
  for (const Prediction& p : predictions) print_row(p.file, p.closed_loop, p.window, p.open_loop);
  print_row("all rows", all.closed_loop, all.window, all.open_loop);
  if (all.closed_loop.rows == 0) {
    fmt::print("closed loop: left out, no recording of this session says what its controller was\n");
  }
  return Status::done;
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("evaluate", "How well a model predicts a session: closed loop, windows, open loop");
  command->footer(
      "Writes NAME.prediction.csv for every recording, with columns t_s, y_m, y_closed_loop_m,\n"
      "y_window_m and y_open_loop_m, and prints the rms errors:\n"
      "  closed loop  the recorded controller and reference, run on the model\n"
      "  windows      the recorded voltage over windows of 0.5 s, each from its own fitted start state\n"
      "  open loop    the recorded voltage from the start, start state from the first 20 rows\n"
      "Example:\n"
      "  cartwright evaluate --model model.toml --session rig/monday --out rig/monday-predicted");
  auto options = std::make_shared<Options>();
  command->add_option("--model", options->model, "model file (TOML)")->required();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_option("--out", options->out, "directory to write the predictions to")->required();
  command->add_flag("--json", options->json, "print one JSON object instead of the table");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
