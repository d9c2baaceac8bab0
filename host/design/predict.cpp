#include <algorithm>
#include <cmath>

#include "host/design/design.hpp"
#include "host/parallel.hpp"

namespace cartwright::design {

Prediction predict(const Trials& trials, const Gains& gains, unsigned threads) {
  struct Both {
    StepRun up;
    StepMetrics worst;
  };
  std::vector<Both> runs(trials.scenarios.size());
  parallel_for(runs.size(), threads, [&](std::size_t i) {
    const Scenario& scenario = trials.scenarios[i];
    StepTest test = trials.step;
    test.bandwidth = true;
    test.warm = scenario.warm;
    runs[i].up = run_step(scenario.model, gains, trials.loop, test);
    Trials with_bandwidth = trials;
    with_bandwidth.step.bandwidth = true;
    runs[i].worst = with_bandwidth.metrics(scenario, gains);
  });
  Prediction out;
  const StepRun& nominal = runs.front().up;
  out.t_s = nominal.t_s;
  out.y_m = out.y_low_m = out.y_high_m = nominal.y_m;
  out.u_V = out.u_low_V = out.u_high_V = nominal.u_V;
  out.always.fill(true);
  for (const Both& run : runs) {
    for (const QuantityInfo& q : quantities()) {
      const double value = run.worst.*q.of;
      const auto at = static_cast<std::size_t>(q.id);
      Estimate& e = out.quantities[at];
      if (&run == &runs.front()) e = {value, value, value};
      out.always[at] = out.always[at] && std::isfinite(value);
      e.low = std::isnan(value) ? value : std::min(e.low, value);
      e.high = std::isnan(value) ? value : std::max(e.high, value);
    }
    const double error = run.worst.final_error;
    if (&run == &runs.front()) out.final_error = {error, error, error};
    out.final_error.low = std::min(out.final_error.low, error);
    out.final_error.high = std::max(out.final_error.high, error);
    for (std::size_t k = 0; k < out.t_s.size(); ++k) {
      out.y_low_m[k] = std::min(out.y_low_m[k], run.up.y_m[k]);
      out.y_high_m[k] = std::max(out.y_high_m[k], run.up.y_m[k]);
      out.u_low_V[k] = std::min(out.u_low_V[k], run.up.u_V[k]);
      out.u_high_V[k] = std::max(out.u_high_V[k], run.up.u_V[k]);
    }
  }
  return out;
}

}  // namespace cartwright::design
