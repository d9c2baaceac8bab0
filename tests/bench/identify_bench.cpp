// Cost of the integral method. Limits to hold: 900 samples with constant damping in 20 us, six intervals in
// 150 us, and a cost that grows linearly with the samples.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "host/identify/integral_form.hpp"

namespace cartwright {
namespace {

/// An underdamped response, its amplitude held up so that long records stay alive.
struct Response {
  std::vector<double> t_s, y_m;
  explicit Response(std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
      const double t = 1e-3 * static_cast<double>(row);
      t_s.push_back(t);
      y_m.push_back(0.1 * std::exp(-3 * std::fmod(t, 0.9)) * std::cos(10 * t));
    }
  }
};

void constant_damping(benchmark::State& state) {
  const Response response(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    ConstantFit fit = fit_constant({response.t_s, response.y_m, {}});
    benchmark::DoNotOptimize(fit);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(constant_damping)->Arg(900)->Unit(benchmark::kMicrosecond);
BENCHMARK(constant_damping)
    ->Name("constant_damping_growth")
    ->RangeMultiplier(10)
    ->Range(1000, 10'000'000)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMicrosecond);

void six_intervals(benchmark::State& state) {
  const Response response(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    PiecewiseFit fit = PiecewiseForm({response.t_s, response.y_m, {}}, 6).fit();
    benchmark::DoNotOptimize(fit);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(six_intervals)->Arg(900)->Unit(benchmark::kMicrosecond);

void six_intervals_rising(benchmark::State& state) {
  const Response response(static_cast<std::size_t>(state.range(0)));
  DampingConstraints rising;
  rising.least_rise_per_s = 0.5;
  for (auto _ : state) {
    PiecewiseFit fit = PiecewiseForm({response.t_s, response.y_m, {}}, 6).fit(rising);
    benchmark::DoNotOptimize(fit);
  }
}
BENCHMARK(six_intervals_rising)->Arg(900)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cartwright

BENCHMARK_MAIN();
