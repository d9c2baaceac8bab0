#pragma once

#include <vector>

#include "common/control/pid.hpp"
#include "common/model/model.hpp"
#include "host/design/step_metrics.hpp"

namespace cartwright::design {

/// The loop the gains will run in.
struct Loop {
  double period_s = 1e-3;
  double voltage_limit_V = 12;
  double encoder_resolution_m = 0;
  double derivative_filter_hz = 50;
  bool derivative_on_measurement = false;
  /// The continuous law of Wongvanich, Hann and Sirisena, Eq. 57-62, in the place of all of the above but the
  /// period, which is then only that of the integration: u = Kp (r - y) - Kd y' + Ki integral of (r - y), no
  /// limit, no filter, no encoder, and no derivative kick at the step.
  bool ideal = false;

  static Loop continuous(double integration_s = 5e-4) { return {.period_s = integration_s, .ideal = true}; }
};

struct Gains {
  double kp_V_per_m = 0, kd_V_s_per_m = 0, ki_V_per_m_s = 0;
};

/// One step of the reference, from rest at `start_m`.
struct StepTest {
  double step_m = 0.1;  ///< either sign, not zero
  double start_m = 0;
  double duration_s = 2;
  double settling_band = 0.02;  ///< of the step
  bool bandwidth = false;       ///< wanted as well; costs about as much as the simulation
  bool warm = false;            ///< motor heated through (motor_heating), not cold
};

/// A simulated step, row by row.
struct StepRun {
  std::vector<double> t_s, y_m, u_V;
  StepMetrics metrics;
};

/// Runs a step of one gain set on a model: encoder, law (common/control), limit and plant (common/model) as
/// in the controller, tick by tick. The reference stands at the start for one tick before the step, so that
/// the derivative sees it (unless on the measurement). An external disturbance belongs to its recording and
/// is left out. Bursts of missed counts come from a fixed seed. Metrics are of the true position.
StepMetrics step_metrics(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test);

/// The same, with all rows kept.
StepRun run_step(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test);

}  // namespace cartwright::design
