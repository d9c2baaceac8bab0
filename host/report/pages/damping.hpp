#pragma once

#include <optional>

#include "common/model/model.hpp"
#include "common/result.hpp"
#include "host/identify/step_response.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// What the paper's integral method finds in one step response.
struct StepDamping {
  StepIdentification constant;  ///< damping constant over the response, Eq. (51)-(53)
  StepIdentification
      piecewise;              ///< over each of six intervals, and its law of speed, Eq. (13)-(29), (67)-(71)
  bool from_voltage = false;  ///< the command was clipped: the recorded voltage took the error's place
};

/// Both, from the first PD step of the session. Fails where there is none, or none with falling damping.
Result<StepDamping> step_damping(const Session& session);

/// Damping over time, and against speed with the law fitted to it; the law of a simulated cart beside it.
void add_damping(Report& page, const StepDamping& step, const std::optional<Model>& truth);

}  // namespace cartwright::report
