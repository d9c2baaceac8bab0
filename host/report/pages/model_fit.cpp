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
  struct Kind {
    const char* caption;
    const char* note;
    SquaredError Prediction::*error;
  };
  // A table each: all in one would be wider than a page.
  constexpr Kind kKinds[] = {
      {"Rms error of position, closed loop",
       "The controller re-run on the model from the recorded reference. A relay's limit cycle keeps the "
       "phase it "
       "once got: small errors add up over its switches, and a model's error there can be as large as the "
       "cycle.",
       &Prediction::closed_loop},
      {"Rms error of position, 0.5 s windows",
       "The recorded voltage replayed over half a second, the start of each window fitted.",
       &Prediction::window},
      {"Rms error of position, open loop",
       "The recorded voltage replayed from the start; what integrates drifts away.", &Prediction::open_loop},
  };
  for (const Kind& kind : kKinds) {
    Table table;
    table.caption = kind.caption;
    table.note = kind.note;
    table.columns = {{"Recording"}};
    for (const NamedModel& one : models) table.columns.push_back({one.name, "mm"});
    std::vector<SquaredError> totals(models.size());
    for (std::size_t i = 0; i < session.recordings.size(); ++i) {
      std::vector<Cell> cells{session.recordings[i].file};
      for (std::size_t m = 0; m < models.size(); ++m) {
        const SquaredError& error = predictions[m][i].*kind.error;
        cells.push_back(rms_mm(error));
        totals[m].add(error);
      }
      table.row(std::move(cells));
    }
    std::vector<Cell> all{Cell("all rows").emphasise()};
    for (const SquaredError& total : totals) all.push_back(rms_mm(total).emphasise());
    table.row(std::move(all));
    page.table(table);
  }
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
