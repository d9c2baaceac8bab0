#include "host/reproduce/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"

namespace cartwright::reproduce {
namespace {

/// A sine that fades in without a jump of its acceleration.
struct Sine {
  double amplitude_m, frequency_hz;

  double at(double time_s) const {
    const double x = std::clamp(time_s * frequency_hz, 0.0, 1.0);
    return x * x * x * (10 + x * (6 * x - 15)) * amplitude_m *
           std::sin(2 * std::numbers::pi * frequency_hz * time_s);
  }
  /// In the middle of the hold that starts at a time.
  ReferenceMotion motion(double time_s, double period_s) const {
    const double r0 = at(time_s), r1 = at(time_s + 0.5 * period_s), r2 = at(time_s + period_s);
    return {r1, (r2 - r0) / period_s, (r2 - 2 * r1 + r0) / (0.25 * period_s * period_s)};
  }
};

}  // namespace

TrackingResult track(const TrackingSetup& setup,
                     const std::function<void(double, double, double, double)>& watch) {
  const Sine sine{setup.amplitude_m, setup.frequency_hz};
  Compensation compensation(setup.period_s);
  compensation.set(Compensation::prepare(setup.compensation, setup.period_s));
  compensation.restart(setup.gains);
  PidController law({setup.gains, setup.ki_V_per_m_s}, setup.period_s, setup.voltage_limit_V);
  Plant plant(setup.truth);
  plant.reset(0);
  Encoder encoder(setup.truth, setup.encoder_step_m);
  std::mt19937_64 random(setup.seed);
  std::normal_distribution<double> noise(0, 1);

  TrackingResult out;
  out.least = out.greatest = compensation.adaptive().estimates();
  double true_sum = 0, measured_sum = 0, variation_V = 0, last_V = 0;
  bool limited = false, changed = false;
  std::size_t counted = 0;
  const auto ticks = static_cast<std::size_t>(std::llround(setup.duration_s / setup.period_s));
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const double time_s = static_cast<double>(tick) * setup.period_s;
    if (!changed && time_s >= setup.change_s) {
      Plant next(setup.later);
      next.reset(plant.state());
      plant = next;
      changed = true;
    }
    const double reference_m = sine.at(time_s);
    const double seen_m = plant.state().position_m + (setup.noise_m > 0 ? setup.noise_m * noise(random) : 0);
    const double reading_m = encoder.read(seen_m, plant.state().velocity_m_per_s, setup.period_s);
    const double added_V =
        compensation.update(sine.motion(time_s, setup.period_s), reference_m, reading_m, limited);
    const double voltage_V = law.update(reference_m, reading_m, added_V);
    limited = std::abs(voltage_V) >= setup.voltage_limit_V;
    if (watch) watch(time_s, reference_m, reading_m, voltage_V);
    if (2 * tick >= ticks) {
      const double true_error = reference_m - plant.state().position_m, error = reference_m - reading_m;
      true_sum += true_error * true_error;
      measured_sum += error * error;
      variation_V += std::abs(voltage_V - last_V);
      ++counted;
    }
    last_V = voltage_V;
    for (std::size_t i = 0; i < AdaptiveEstimates::kCount; ++i) {
      const double value = compensation.adaptive().estimates().value[i];
      out.least.value[i] = std::min(out.least.value[i], value);
      out.greatest.value[i] = std::max(out.greatest.value[i], value);
    }
    plant.advance(voltage_V, setup.period_s);
  }
  const auto count = static_cast<double>(counted);
  out.error_rms_m = std::sqrt(true_sum / count);
  out.measured_error_rms_m = std::sqrt(measured_sum / count);
  out.variation_V_per_s = variation_V / (count * setup.period_s);
  out.last = compensation.adaptive().estimates();
  out.limits_met = compensation.limits_met();
  return out;
}

}  // namespace cartwright::reproduce
