#include "host/design/step_test.hpp"

#include <cmath>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"

namespace cartwright::design {
namespace {

constexpr double kInnerStep_s = 1e-3;
constexpr double kHeatedThrough = 40;  // time constants: exp(-40) is nothing

Plant plant_at_start(const Model& model, const StepTest& test) {
  PlantOptions options;
  options.disturbance_active = false;
  // One inner step a tick: fourth order, events located; stiff terms choose a finer one by themselves.
  options.step_s = kInnerStep_s;
  if (test.warm) options.heating_start_s = -kHeatedThrough * model[Parameter::heating_time_constant];
  Plant plant(model, options);
  plant.reset(test.start_m);
  return plant;
}

/// Calls `row(time_s, y_m, u_V, held_s)` for every tick from the step on.
template <typename Row>
void run_sampled(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test, Row row) {
  Plant plant = plant_at_start(model, test);
  Encoder encoder(model, loop.encoder_resolution_m);
  PidController law(
      {{gains.kp_V_per_m, gains.kd_V_s_per_m, loop.derivative_filter_hz, loop.derivative_on_measurement},
       gains.ki_V_per_m_s},
      loop.period_s, loop.voltage_limit_V);
  const double first_m = encoder.read(plant.state().position_m, 0, 0);
  law.update(first_m, first_m);
  const double reference_m = test.start_m + test.step_m;
  const long ticks = std::lround(test.duration_s / loop.period_s);
  for (long tick = 0; tick <= ticks; ++tick) {
    const PlantState& state = plant.state();
    const double reading_m = encoder.read(state.position_m, state.velocity_m_per_s, loop.period_s);
    const double u_V = law.update(reference_m, reading_m);
    const double held_s = tick < ticks ? loop.period_s : 0;
    row(static_cast<double>(tick) * loop.period_s, state.position_m, u_V, held_s);
    if (held_s > 0) plant.advance(u_V, held_s);
  }
}

/// The continuous law by holding, over each short period, its value half way through, extrapolated from the
/// speed and its last change: second order in the period.
template <typename Row>
void run_ideal(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test, Row row) {
  Plant plant = plant_at_start(model, test);
  const double reference_m = test.start_m + test.step_m;
  const double h = loop.period_s;
  const long ticks = std::lround(test.duration_s / h);
  double last_v = 0, integral_m_s = 0;
  for (long tick = 0; tick <= ticks; ++tick) {
    const double y = plant.state().position_m, v = plant.state().velocity_m_per_s;
    const double error = reference_m - y;
    const double now_V =
        gains.kp_V_per_m * error - gains.kd_V_s_per_m * v + gains.ki_V_per_m_s * integral_m_s;
    const double change = v == 0 ? 0 : 0.5 * (v - last_v);
    const double mean_V = now_V - gains.kp_V_per_m * 0.5 * h * (v + 0.5 * change) -
                          gains.kd_V_s_per_m * change + gains.ki_V_per_m_s * 0.5 * h * error;
    row(static_cast<double>(tick) * h, y, now_V, tick < ticks ? h : 0);
    if (tick < ticks) plant.advance(mean_V, h);
    integral_m_s += h * (error - 0.5 * h * v);
    last_v = v;
  }
}

template <typename Row>
void run(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test, Row row) {
  loop.ideal ? run_ideal(model, gains, loop, test, row) : run_sampled(model, gains, loop, test, row);
}

}  // namespace

StepMetrics step_metrics(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test) {
  StepMeter meter(test.settling_band);
  std::vector<double> z;
  if (test.bandwidth) z.reserve(static_cast<std::size_t>(test.duration_s / loop.period_s) + 2);
  run(model, gains, loop, test, [&](double t_s, double y_m, double u_V, double held_s) {
    const double part = (y_m - test.start_m) / test.step_m;
    meter.add(t_s, part, u_V, held_s);
    if (test.bandwidth) z.push_back(part);
  });
  StepMetrics metrics = meter.metrics();
  if (test.bandwidth) metrics.bandwidth_hz = bandwidth_hz(z, loop.period_s);
  return metrics;
}

StepRun run_step(const Model& model, const Gains& gains, const Loop& loop, const StepTest& test) {
  StepRun out;
  StepMeter meter(test.settling_band);
  std::vector<double> z;
  run(model, gains, loop, test, [&](double t_s, double y_m, double u_V, double held_s) {
    out.t_s.push_back(t_s);
    out.y_m.push_back(y_m);
    out.u_V.push_back(u_V);
    z.push_back((y_m - test.start_m) / test.step_m);
    meter.add(t_s, z.back(), u_V, held_s);
  });
  out.metrics = meter.metrics();
  out.metrics.bandwidth_hz = bandwidth_hz(z, loop.period_s);
  return out;
}

}  // namespace cartwright::design
