#pragma once

#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "common/result.hpp"
#include "host/identify/damping_law.hpp"
#include "host/identify/identify.hpp"
#include "host/identify/integral_form.hpp"

namespace cartwright {

/// Which equation the double integrals are taken of.
enum class StepInput {
  error,    ///< the paper's: e'' + (C + beta Kd) e' + beta Kp e = 0, for an ideal controller and a constant
            ///< reference
  voltage,  ///< y'' + C y' - beta u = 0 with the recorded, held voltage
};

struct StepOptions {
  std::string file;         ///< the recording to use; empty: the first PD step of the session
  double duration_s = 0.9;  ///< from the step of the reference on
  StepInput input = StepInput::error;
  std::size_t intervals = 1;  ///< 1: constant damping
  DampingConstraints constraints;
  int draws = 500;
};

/// The rows of one step: from the change of the reference to the next change, at most `duration_s`.
struct StepResponse {
  std::string file;
  std::vector<double> t_s, e_m, y_m, u_V;
  std::vector<double> speed_m_per_s;
  PdGains gains;
};

/// Damping over one interval.
struct DampingInterval {
  double start_s = 0, end_s = 0;
  double speed_m_per_s = 0;  ///< mean |v| (Eq. 66, ERRATA)
  Estimate damping_per_s;
};

struct StepIdentification {
  std::string file;
  Model model;  ///< viscous friction for one interval, the exponential law for more
  std::vector<ParameterEstimate> estimates;
  std::vector<DampingInterval> damping;
  KktResidual kkt;
  double residual_m = 0;       ///< rms of fitted less measured
  double mean_residual_m = 0;  ///< mean absolute value of it
};

/// Cuts the step out of a session. The error form refuses a step in which the command was clipped: Eq. (59)
/// then does not hold (ERRATA, Eq. 57-62), and the voltage form is the one to use.
Result<StepResponse> find_step(const Session& session, const StepOptions& options);

/// The paper's identification from a single step response: Eq. (51)-(53) and (63) for one interval; Eq.
/// (13)-(29) and the damping law of Eq. (67)-(71) for more. Intervals by a wild bootstrap of 50 ms blocks of
/// the residuals.
Result<StepIdentification> identify_step(const StepResponse& step, const StepOptions& options);

}  // namespace cartwright
