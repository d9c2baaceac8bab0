#include "host/report/pages/model_fit.hpp"

#include <fmt/format.h>

#include "host/report/session_page.hpp"

namespace cartwright::report {
namespace {

constexpr double kMillimetres = 1e3;

Cell rms_mm(const SquaredError& error) {
  return Cell::number(kMillimetres * error.rms_m(), 3);
}

}  // namespace

Predictions predict_all(const Session& session, const std::vector<NamedModel>& models) {
  Predictions out;
  for (const NamedModel& one : models) {
    auto& of_model = out.emplace_back();
    for (const Recording& recording : session.recordings) {
      of_model.push_back(predict(one.model, session.rig, recording));
    }
  }
  return out;
}

void add_fit_table(Report& page, const Session& session, const std::vector<NamedModel>& models,
                   const Predictions& predictions) {
  Table table;
  table.caption = "Rms error of position";
  table.columns = {{"Recording"}};
  for (const NamedModel& one : models) {
    table.columns.push_back({one.name + ", closed loop", "mm"});
    table.columns.push_back({one.name + ", 0.5 s windows", "mm"});
    table.columns.push_back({one.name + ", open loop", "mm"});
  }
  std::vector<SquaredError> totals(3 * models.size());
  for (std::size_t i = 0; i < session.recordings.size(); ++i) {
    std::vector<Cell> cells{session.recordings[i].file};
    for (std::size_t m = 0; m < models.size(); ++m) {
      const Prediction& prediction = predictions[m][i];
      const SquaredError* const errors[] = {&prediction.closed_loop, &prediction.window,
                                            &prediction.open_loop};
      for (std::size_t k = 0; k < 3; ++k) {
        cells.push_back(rms_mm(*errors[k]));
        totals[3 * m + k].add(*errors[k]);
      }
    }
    table.row(std::move(cells));
  }
  std::vector<Cell> all{Cell("all rows").emphasise()};
  for (const SquaredError& total : totals) all.push_back(rms_mm(total).emphasise());
  table.row(std::move(all));
  table.note =
      "Closed loop: the controller re-run on the model from the recorded reference. Windows: the recorded "
      "voltage "
      "replayed over half a second, the start of each window fitted. Open loop: the recorded voltage "
      "replayed from "
      "the start; what integrates drifts away.";
  page.table(table);
}

void add_recordings(Report& page, const Session& session, const std::vector<NamedModel>& models,
                    const Predictions& predictions) {
  for (std::size_t i = 0; i < session.recordings.size(); ++i) {
    const Recording& recording = session.recordings[i];
    std::vector<Overlay> overlays;
    for (std::size_t m = 0; m < models.size(); ++m) {
      const Prediction& prediction = predictions[m][i];
      const bool closed = !prediction.closed_loop_m.empty();
      overlays.push_back({models[m].name + (closed ? "" : ", 0.5 s windows"),
                          models[m].colour,
                          recording.t_s,
                          closed ? prediction.closed_loop_m : prediction.window_m,
                          {}});
    }
    page.details(
        fmt::format("{} ({}; {})", recording.file, recording.experiment, describe(recording.controller)),
        [&](Report& inside) {
          std::vector<Plot> plots = recording_plots(recording, overlays);
          plots.front().title.clear();
          for (const Plot& plot : plots) inside.plot(plot);
        });
  }
}

}  // namespace cartwright::report
