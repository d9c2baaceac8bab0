#pragma once

#include <cstdint>

#include "host/diagnose/locate/locate.hpp"

namespace cartwright {

/// Size of the reading error and of the disturbance acceleration that a fit found.
struct NoiseSize {
  double reading_m = 0;
  double disturbance_m_per_s2 = 0;
  double correlation_time_s = 0;
};
NoiseSize noise_size(const Fit& fit, const Rig& rig, double damping_per_s);

/// The same experiments on a cart that is exactly `model`, with a disturbance and a reading error of the
/// given size: each recording's own controller in closed loop at the recorded times (its recorded voltage
/// where it has none).
Session surrogate(const Session& session, const Model& model, const NoiseSize& noise, std::uint64_t seed);

/// The experiments of a fit on a cart that is exactly its model, to see what such a cart shows. What a fit
/// takes for a disturbance may be the rounding of the readings: of a cart with it and one without, the one
/// whose errors are nearer in size to the fit's.
Alike alike(const Session& session, const Fit& fit, const FitOptions& options);

}  // namespace cartwright
