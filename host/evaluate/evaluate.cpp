#include "host/evaluate/evaluate.hpp"

#include <limits>

#include "host/evaluate/closed_loop.hpp"

namespace cartwright {

Prediction predict(const Model& model, const Rig& rig, const Recording& recording,
                   const ReplayOptions& options) {
  Prediction out;
  out.file = recording.file;
  if (recording.has_controller()) {
    out.closed_loop_m = simulate(model, rig, recording).y_m;
    out.closed_loop = squared_error(out.closed_loop_m, recording.y_m);
  }
  out.window_m = replay_windows(model, recording, options);
  out.window = squared_error(out.window_m, recording.y_m);
  out.open_loop_m = replay_open_loop(model, recording, options);
  out.open_loop = open_loop_error(out.open_loop_m, recording, options);
  return out;
}

CsvTable to_table(const Prediction& prediction, const Recording& recording) {
  CsvTable table;
  table.names = {"t_s", "y_m", "y_closed_loop_m", "y_window_m", "y_open_loop_m"};
  table.columns = {recording.t_s, recording.y_m, prediction.closed_loop_m, prediction.window_m,
                   prediction.open_loop_m};
  for (std::vector<double>& column : table.columns) {
    column.resize(recording.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return table;
}

}  // namespace cartwright
