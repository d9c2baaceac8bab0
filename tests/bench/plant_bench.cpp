// Cost of one simulated millisecond: the closed form, the numerical one-mass integrator bare and with costly
// terms, two masses. Steps of a millisecond, as the diagnosis uses them.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "common/model/plant.hpp"

namespace cartwright {
namespace {

using P = Parameter;

void ticks(benchmark::State& bench, const Model& model) {
  std::array<double, 1024> command_V{};
  for (std::size_t i = 0; i < command_V.size(); ++i)
    command_V[i] = 4 * std::sin(0.05 * static_cast<double>(i));
  PlantOptions options;
  options.step_s = 1e-3;
  Plant plant(model, options);
  plant.reset(0);
  std::size_t tick = 0;
  for (auto _ : bench) {
    plant.advance(command_V[tick++ % command_V.size()], 1e-3);
    benchmark::DoNotOptimize(plant.state());
  }
}

Model nominal() {
  return Model(1.9).set(P::viscous_coefficient, 5).set(P::coulomb_level, 0.5);
}

BENCHMARK_CAPTURE(ticks, nominal, nominal());
BENCHMARK_CAPTURE(ticks, drag, nominal().set(P::drag_coefficient, 1));
BENCHMARK_CAPTURE(ticks, stribeck, nominal().set(P::stribeck_excess, 0.2).set(P::stribeck_speed, 0.02));
BENCHMARK_CAPTURE(ticks, spot,
                  nominal().set(P::spot_peak, 0.2).set(P::spot_centre, 0.02).set(P::spot_width, 0.02));
BENCHMARK_CAPTURE(ticks, cogging, nominal().set(P::cogging_amplitude, 0.3).set(P::cogging_period, 0.02));
BENCHMARK_CAPTURE(ticks, lag, nominal().set(P::armature_time_constant, 5e-3));
BENCHMARK_CAPTURE(ticks, delay, nominal().set(P::transport_delay, 3.3e-3));
BENCHMARK_CAPTURE(ticks, heating, nominal().set(P::heating_gain_loss, 0.1).set(P::heating_time_constant, 60));
BENCHMARK_CAPTURE(ticks, presliding, nominal().set(P::presliding_stiffness, 2e4));
BENCHMARK_CAPTURE(ticks, backlash, nominal().set(P::backlash_gap, 5e-4));
BENCHMARK_CAPTURE(ticks, coupling,
                  nominal()
                      .set(P::coupling_resonance, 20)
                      .set(P::coupling_damping_ratio, 0.05)
                      .set(P::coupling_load_share, 0.4));

}  // namespace
}  // namespace cartwright

BENCHMARK_MAIN();
