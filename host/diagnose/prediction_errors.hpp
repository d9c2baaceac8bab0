#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/evaluate/replay.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Root-mean-square error [m] of 0.5 s windows of a session, replayed from the recorded voltage.
double window_rmse_m(const Model& model, const Session& session, unsigned threads);

/// The error of each of these windows, recordings in order.
std::vector<SquaredError> window_errors(const Model& model, const Session& session, unsigned threads);

/// Root-mean-square error [m] of all of them; NaN for none.
double rms_m(const std::vector<SquaredError>& windows);

/// Root-mean-square error [m] with each recording's own controller run on the model from its reference; NaN
/// where no recording comes with a controller.
double closed_loop_rmse_m(const Model& model, const Session& session, unsigned threads);

}  // namespace cartwright
