#pragma once

#include <vector>

#include "host/evaluate/evaluate.hpp"
#include "host/report/pages/named_model.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// What each model predicts of each recording: `[model][recording]`.
using Predictions = std::vector<std::vector<Prediction>>;
Predictions predict_all(const Session& session, const std::vector<NamedModel>& models);

/// A table per error, a row per recording and a column per model: closed loop, 0.5 s windows, open loop.
void add_fit_table(Report& page, const Session& session, const std::vector<NamedModel>& models,
                   const Predictions& predictions);

/// Every recording with every model's closed loop (or, without a controller, its windows) over it, folded
/// away.
void add_recordings(Report& page, const Session& session, const std::vector<NamedModel>& models,
                    const Predictions& predictions);

}  // namespace cartwright::report
