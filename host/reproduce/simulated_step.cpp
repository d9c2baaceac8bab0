#include "host/reproduce/simulated_step.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "common/control/pd.hpp"
#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"

namespace cartwright::reproduce {

Session simulated_step(const Model& cart, const StepSetup& setup) {
  Session session;
  session.rig.encoder_resolution_m = setup.encoder_resolution_m;
  const double period_s = session.rig.period_s();
  const auto before = static_cast<std::size_t>(std::lround(setup.before_s / period_s));
  const auto rows = before + static_cast<std::size_t>(std::lround(setup.duration_s / period_s)) + 1;
  Recording recording;
  recording.file = "step.csv";
  recording.experiment = "step";
  const PdGains gains{setup.gains.kp_V_per_m, setup.gains.kd_V_s_per_m};
  recording.controller = gains;
  PdController law(gains, period_s, session.rig.voltage_limit_V);
  Plant plant(cart);
  Encoder encoder(cart, setup.encoder_resolution_m);
  const double start_m = setup.reading_phase * setup.encoder_resolution_m;
  plant.reset(start_m);
  std::mt19937_64 random(setup.seed);
  std::normal_distribution<double> noise(0, setup.noise_m > 0 ? setup.noise_m : 1);
  for (std::size_t row = 0; row < rows; ++row) {
    const PlantState& state = plant.state();
    const double error_m = setup.noise_m > 0 ? noise(random) : 0;
    recording.t_s.push_back(static_cast<double>(row) * period_s);
    recording.r_m.push_back(row < before ? 0 : kStep_m);
    recording.y_m.push_back(encoder.read(state.position_m + error_m, state.velocity_m_per_s, period_s));
    recording.u_V.push_back(law.update(recording.r_m.back(), recording.y_m.back()));
    plant.advance(recording.u_V.back(), period_s);
  }
  session.recordings.push_back(std::move(recording));
  return session;
}

std::size_t step_row(const Recording& recording) {
  const auto moved = std::find(recording.r_m.begin(), recording.r_m.end(), kStep_m);
  return static_cast<std::size_t>(moved - recording.r_m.begin());
}

IdealResponse ideal_response(const Model& cart, GainPair gains, double duration_s) {
  constexpr std::size_t kPerTick = 2;
  IdealResponse out;
  design::StepTest test;
  test.step_m = kStep_m;
  test.duration_s = duration_s;
  const design::StepRun run =
      design::run_step(cart, {gains.kp_V_per_m, gains.kd_V_s_per_m},
                       design::Loop::continuous(out.period_s / static_cast<double>(kPerTick)), test);
  for (std::size_t row = 0; row < run.y_m.size(); row += kPerTick) {
    out.y_m.push_back(run.y_m[row]);
    out.u_V.push_back(run.u_V[row]);
  }
  return out;
}

design::Loop stepped_transfer_function(double period_s) {
  constexpr double kNoLimit_V = 1e9, kNoFilter_hz = 1e9;
  return {.period_s = period_s, .voltage_limit_V = kNoLimit_V, .derivative_filter_hz = kNoFilter_hz};
}

}  // namespace cartwright::reproduce
