// Cost of a sine fit, start included. Limit to hold: 3000 samples in 100 us.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "host/relay/sinefit.hpp"

namespace cartwright {
namespace {

struct Record {
  std::vector<double> t_s, y;

  Record(std::size_t rows, double noise, double third_harmonic, double jitter_s, double period_s = 1e-3) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> late(0, 1);
    for (std::size_t row = 0; row < rows; ++row) {
      const double t = period_s * static_cast<double>(row) + jitter_s * late(random);
      const double angle = 2 * std::numbers::pi * 3.3 * t + 0.3;
      t_s.push_back(t);
      y.push_back(0.2 + std::sin(angle) + third_harmonic * std::sin(3 * angle) + noise * normal(random));
    }
  }
};

void fit(benchmark::State& state, const Record& record) {
  for (auto _ : state) {
    auto found = sinefit(record.t_s, record.y);
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK_CAPTURE(fit, in_noise_3000, Record(3000, 0.22, 0, 0))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fit, jittering_times_3000, Record(3000, 0.22, 0, 1e-4))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fit, at_0_decibels_3000, Record(3000, 0.71, 0, 0))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fit, beside_a_harmonic_3000, Record(3000, 0.001, 0.1, 0))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fit, in_noise_401, Record(401, 0.22, 0, 0, 5e-3))->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cartwright

BENCHMARK_MAIN();
