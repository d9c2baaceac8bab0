#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/evaluate/replay.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Root-mean-square error [m] of 0.5 s windows of a session, replayed from the recorded voltage. Two masses
/// are taken as linear by steps, which changes it in the fourth digit.
double window_rmse_m(const Model& model, const Session& session, unsigned threads);

/// The error of each of these windows, recordings in order.
std::vector<SquaredError> window_errors(const Model& model, const Session& session, unsigned threads);

/// Root-mean-square error [m] of all of them; NaN where they have no row.
double rms_m(const std::vector<SquaredError>& errors);

/// Whether windows are predicted worse by one model than by another, window by window, beyond chance (97.5 %,
/// by Student's t of their mean squares).
bool worse_beyond_chance(const std::vector<SquaredError>& by, const std::vector<SquaredError>& than_by);

/// The error of each recording with its own controller run on the model from its reference; of no row where a
/// recording comes without a controller.
std::vector<SquaredError> closed_loop_errors(const Model& model, const Session& session, unsigned threads);

}  // namespace cartwright
