#pragma once

#include <vector>

#include "host/report/pages/named_model.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// How far models are from one step response, each run with the recording's own gains.
struct GainPairError {
  std::string file;
  double kp_V_per_m = 0, kd_V_s_per_m = 0;
  std::vector<double> over_1_s_m, over_half_s_m;  ///< mean absolute error after the step, one per model
};

/// The first step recording of every pair of gains, in order of Kp and Kd: the errors of each model over 1 s
/// and 0.5 s after the first step of the reference, as Table 2 of Wongvanich, Hann and Sirisena (2015) counts
/// them.
std::vector<GainPairError> gain_pair_errors(const Session& session, const std::vector<NamedModel>& models);

/// One small plot per pair (measured and every model, the second after the step), then the table.
void add_gain_pairs(Report& page, const Session& session, const std::vector<NamedModel>& models);

}  // namespace cartwright::report
