#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Root-mean-square error [m] of 0.5 s windows of a session, replayed from the recorded voltage.
double window_rmse_m(const Model& model, const Session& session, unsigned threads);

/// Mean square error [m^2] of each of these windows, recordings in order.
std::vector<double> window_mse_m2(const Model& model, const Session& session, unsigned threads);

/// Root-mean-square error [m] with each recording's own controller run on the model from its reference; NaN
/// where no recording comes with a controller.
double closed_loop_rmse_m(const Model& model, const Session& session, unsigned threads);

}  // namespace cartwright
