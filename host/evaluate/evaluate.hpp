#pragma once

#include <string>
#include <vector>

#include "host/evaluate/replay.hpp"

namespace cartwright {

/// What a model predicts of one recording, row by row, in three ways; NaN where it says nothing.
struct Prediction {
  std::string file;
  std::vector<double> closed_loop_m;  ///< empty for a recording without a controller
  std::vector<double> window_m;
  std::vector<double> open_loop_m;
  SquaredError closed_loop, window, open_loop;
};

Prediction predict(const Model& model, const Rig& rig, const Recording& recording,
                   const ReplayOptions& options = {});

/// Columns t_s, y_m, y_closed_loop_m, y_window_m, y_open_loop_m.
CsvTable to_table(const Prediction& prediction, const Recording& recording);

}  // namespace cartwright
