// What identification while running adds to a tick, and what compensation does. Ticks are timed one by one
// as well: a window or a block that ends must not make one tick long.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/control/compensation.hpp"
#include "common/identify/online.hpp"
#include "common/model/encoder.hpp"

namespace cartwright {
namespace {

struct Row {
  double t_s, y_m, u_V, r_m;
};

/// A minute of a tracked multisine at a rate.
std::vector<Row> recorded(double rate_hz) {
  const Model cart = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
  Plant plant(cart);
  plant.reset(0);
  Encoder encoder(cart, 2.275e-5);
  PdController law({80, 2, 50, false}, 1 / rate_hz, 12);
  std::vector<Row> rows;
  for (int tick = 0; tick < 60 * rate_hz; ++tick) {
    const double t = tick / rate_hz, w = 2 * std::numbers::pi;
    const double r = 0.05 * (std::sin(0.4 * w * t) + std::sin(1.1 * w * t));
    const double y = encoder.read(plant.state().position_m, 0, 1 / rate_hz);
    rows.push_back({t, y, law.update(r, y), r});
    plant.advance(rows.back().u_V, 1 / rate_hz);
  }
  return rows;
}

void identification_tick(benchmark::State& bench) {
  const auto rate_hz = static_cast<double>(bench.range(0));
  const std::vector<Row> rows = recorded(rate_hz);
  OnlineSetup setup;
  setup.rows.period_s = 1 / rate_hz;
  std::vector<double> took_us;
  for (auto _ : bench) {
    OnlineIdentification online(setup);
    online.begin({{80, 2, 50, false}, 0});
    for (const Row& row : rows) {
      const auto before = std::chrono::steady_clock::now();
      online.tick(row.t_s, row.y_m, row.u_V, row.r_m, 0);
      const auto after = std::chrono::steady_clock::now();
      took_us.push_back(std::chrono::duration<double, std::micro>(after - before).count());
    }
    benchmark::DoNotOptimize(online.estimates());
  }
  std::sort(took_us.begin(), took_us.end());
  const auto part = [&](double p) {
    return took_us[static_cast<std::size_t>(p * static_cast<double>(took_us.size() - 1))];
  };
  bench.counters["median_us"] = part(0.5);
  bench.counters["p99_us"] = part(0.99);
  bench.counters["p999_us"] = part(0.999);
}
BENCHMARK(identification_tick)->Arg(1000)->Arg(4000)->Iterations(5)->Unit(benchmark::kMillisecond);

void compensation_tick(benchmark::State& bench) {
  CompensationSettings settings;
  settings.mode = static_cast<CompensationMode>(bench.range(0));
  settings.model = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
  settings.adaptive = adaptive_about(settings.model, {}, 1, 12);
  Compensation compensation(1e-3);
  compensation.set(Compensation::prepare(settings, 1e-3));
  ReferenceMotion motion{0.1, 0.2, 0.3};
  for (auto _ : bench) {
    motion.velocity_m_per_s = -motion.velocity_m_per_s;
    benchmark::DoNotOptimize(compensation.update(motion, 0.1, 0.09, false));
  }
}
BENCHMARK(compensation_tick)->DenseRange(0, 2);

}  // namespace
}  // namespace cartwright

BENCHMARK_MAIN();
