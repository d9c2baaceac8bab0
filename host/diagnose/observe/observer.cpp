#include "host/diagnose/observe/observer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/model/plant.hpp"
#include "host/diagnose/observe/two_mass_gain.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

constexpr double kSettling_s = 0.05;
constexpr std::size_t kLeastRowsOfParabola = 4;
constexpr double kFinestReading_m = 1e-6;  // where the rig file gives no resolution
/// Corrected every tick, the plant needs no more than its own shape right: w h = 0.45, and 1.8 where a series
/// is taken, which is exact but for a second event within the step.
constexpr double kStiffStepFactor = 3;
/// w h = 0.9: 0.5 % of what a bristle swings, and still stable. Two masses touch within such steps.
constexpr double kCoarseStepFactor = 6;

/// Speed at a row where the model starts, zero unless it shows: from the parabola through the readings that
/// follow, so that a cart pushed from rest is seen to start from rest.
double start_velocity(const Rig& rig, const Recording& recording, std::size_t first) {
  const auto rows = static_cast<Eigen::Index>(
      std::min(recording.size() - first, settling_rows(rig) / 2 + kLeastRowsOfParabola));
  if (rows < static_cast<Eigen::Index>(kLeastRowsOfParabola)) return 0;
  Eigen::MatrixX3d powers(rows, 3);
  Eigen::VectorXd moved(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const std::size_t at = first + static_cast<std::size_t>(k);
    const double t = recording.t_s[at] - recording.t_s[first];
    powers.row(k) << 1, t, t * t;
    moved[k] = recording.y_m[at] - recording.y_m[first];
  }
  const double slope = powers.colPivHouseholderQr().solve(moved)[1];
  const double span = powers(rows - 1, 1);
  return std::abs(slope * span) > 3 * rig.encoder_resolution_m ? slope : 0.0;
}

}  // namespace

std::size_t settling_rows(const Rig& rig) {
  return static_cast<std::size_t>(kSettling_s * rig.sample_rate_hz) + 1;
}

double linear_damping(const Model& model) {
  double c = 0;
  if (model.has(Term::viscous_friction)) c += model[Parameter::viscous_coefficient];
  if (model.has(Term::exponential_damping)) c += model[Parameter::exponential_gamma];
  return std::clamp(c, 0.0, 100.0);
}

Observation observe(const Model& model, const ObserverGains& gains, const Rig& rig,
                    const Recording& recording, const ObserverOptions& options) {
  PlantOptions plant_options;
  plant_options.step_s = options.step_s;
  const bool one_mass = !model.has(Term::backlash) && !model.has(Term::flexible_coupling);
  plant_options.stiff_step_factor = options.coarsely && one_mass ? kCoarseStepFactor : kStiffStepFactor;
  plant_options.linear_by_steps = true;
  plant_options.disturbance_active = model.disturbance_recording == recording.file;
  plant_options.heating_start_s = recording.t_s.front();
  Plant plant(model, plant_options);
  plant.reset(recording.y_m.front(), start_velocity(rig, recording, 0), recording.t_s.front());

  const bool eccentric = model.has(Term::encoder_eccentricity);
  const double amplitude = model[Parameter::eccentricity_amplitude];
  const double wavenumber = eccentric ? 2 * std::numbers::pi / model[Parameter::eccentricity_period] : 0;
  const double phase = model[Parameter::eccentricity_phase];

  std::optional<TwoMassGain> two_masses;
  if (model.has(Term::backlash)) {
    const double count_m = rig.encoder_resolution_m > 0 ? rig.encoder_resolution_m : kFinestReading_m;
    two_masses.emplace(model, gains.noise, rig.period_s(), gains.damping_per_s, count_m);
  }

  Observation out;
  const std::size_t rows = recording.size();
  out.error_m.assign(rows, 0.0);
  if (two_masses) out.spread.assign(rows, 1.0);
  if (options.keep_states) {
    out.velocity_m_per_s.assign(rows, 0.0);
    out.acceleration_m_per_s2.assign(rows, 0.0);
    out.disturbance_m_per_s2.assign(rows, 0.0);
  }
  const double longest_step = 3 * rig.period_s();
  double disturbance = 0;
  std::size_t start = 0;
  for (std::size_t k = 1; k < rows; ++k) {
    const double elapsed = recording.t_s[k] - recording.t_s[k - 1];
    if (elapsed > longest_step) {  // a gap: begin anew behind it, never guess across
      plant.reset(recording.y_m[k], start_velocity(rig, recording, k), recording.t_s[k]);
      disturbance = 0;
      start = k;
      if (two_masses) two_masses->restart();
      continue;
    }
    const double velocity_before = plant.state().velocity_m_per_s;
    plant.advance(recording.u_V[k - 1], elapsed, disturbance);
    const PlantState& state = plant.state();
    double reading = state.position_m;
    if (eccentric) reading += amplitude * std::sin(wavenumber * state.position_m + phase);
    const double error = recording.y_m[k] - reading;
    out.error_m[k] = error;
    if (options.keep_states) {
      out.velocity_m_per_s[k] = state.velocity_m_per_s;
      out.acceleration_m_per_s2[k] = (state.velocity_m_per_s - velocity_before) / elapsed;
      out.disturbance_m_per_s2[k] = disturbance;
    }
    if (two_masses) {
      const TwoMassGain::Gain gain = two_masses->step(state.contact != 0);
      out.spread[k] = std::sqrt(gain.error_variance_ratio);
      disturbance = two_masses->disturbance_decay() * (disturbance + gain.disturbance_per_s2 * error);
      plant.correct(state.position_m + gain.position * error,
                    state.velocity_m_per_s + gain.velocity_per_s * error,
                    state.motor_position_m + gain.motor_position * error,
                    state.motor_velocity_m_per_s + gain.motor_velocity_per_s * error);
      continue;
    }
    const ObserverGain& gain = gains.at(k - start);
    disturbance = gain.disturbance_decay * disturbance + gain.disturbance_per_s2 * error;
    plant.correct(state.position_m + gain.position * error,
                  state.velocity_m_per_s + gain.velocity_per_s * error);
  }
  return out;
}

std::vector<Observation> observe(const Model& model, const ObserverGains& gains, const Session& session,
                                 const ObserverOptions& options, unsigned threads) {
  std::vector<Observation> seen(session.recordings.size());
  parallel_for(seen.size(), threads, [&](std::size_t n) {
    seen[n] = observe(model, gains, session.rig, session.recordings[n], options);
  });
  return seen;
}

}  // namespace cartwright
