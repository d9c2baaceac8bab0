#include "host/diagnose/judge/surrogate.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"
#include "host/evaluate/control_law.hpp"

namespace cartwright {
namespace {

double rms(const std::vector<double>& values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

}  // namespace

NoiseSize noise_size(const Fit& fit, const Rig& rig, double damping_per_s) {
  const ObserverGain gain = observer_gains(fit.noise, rig.period_s(), damping_per_s).settled;
  const double reading = fit.error_rms_m / std::sqrt(gain.error_variance_ratio);
  return {reading, fit.noise.disturbance_per_reading_per_s2 * reading, fit.noise.correlation_time_s};
}

Session surrogate(const Session& session, const Model& model, const NoiseSize& noise, std::uint64_t seed) {
  Session out = session;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double count = session.rig.encoder_resolution_m;
  // Rounding to counts is part of the reading error; only the rest is drawn.
  const double added = std::sqrt(std::max(0.0, noise.reading_m * noise.reading_m - count * count / 12));
  for (Recording& r : out.recordings) {
    PlantOptions options;
    options.step_s = 1e-3;
    options.disturbance_active = model.disturbance_recording == r.file;
    options.heating_start_s = r.t_s.front();
    Plant plant(model, options);
    plant.reset(r.y_m.front(), 0, r.t_s.front());
    Encoder encoder(model, 0, random());
    ControlLaw law(session.rig, r);
    double push = noise.disturbance_m_per_s2 * normal(random);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const PlantState& state = plant.state();
      const double elapsed = k == 0 ? 0 : r.t_s[k] - r.t_s[k - 1];
      double reading =
          encoder.read(state.position_m, state.velocity_m_per_s, elapsed) + added * normal(random);
      if (count > 0) reading = count * std::round(reading / count);
      r.y_m[k] = reading;
      r.u_V[k] = law.command_V(k, reading);
      if (k + 1 == r.size()) break;
      const double step = r.t_s[k + 1] - r.t_s[k];
      plant.advance(r.u_V[k], step, push);
      const double decay = std::exp(-step / noise.correlation_time_s);
      push = decay * push + noise.disturbance_m_per_s2 * std::sqrt(1 - decay * decay) * normal(random);
    }
  }
  return out;
}

Alike alike(const Session& session, const Fit& fit, const FitOptions& options) {
  NoiseSize noise = noise_size(fit, session.rig, options.damping_per_s);
  const auto with_noise = [&] {
    Session other = surrogate(session, fit.model, noise, 1);
    std::vector<double> error_m = counted_errors(other, fit.model, fit.noise, options).error_m;
    return Alike{std::move(other), std::move(error_m)};
  };
  Alike shaken = with_noise();
  if (session.rig.encoder_resolution_m <= 0) return shaken;
  noise.disturbance_m_per_s2 = 0;
  Alike still = with_noise();
  const auto unlike = [&](const Alike& other) { return std::abs(rms(other.error_m) - rms(fit.error_m)); };
  return unlike(still) < unlike(shaken) ? std::move(still) : std::move(shaken);
}

}  // namespace cartwright
