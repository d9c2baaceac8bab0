#pragma once

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// Root-mean-square error [m] of 0.5 s windows of a session, replayed from the recorded voltage.
double window_rmse_m(const Model& model, const Session& session, unsigned threads);

}  // namespace cartwright
