#pragma once

#include <cstdint>

#include "host/diagnose/fit/fit.hpp"

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

/// The errors that a fit would have if the cart were exactly its model: a row for each of the fit's.
std::vector<double> errors_of_surrogate(const Session& session, const Fit& fit, FitOptions options,
                                        unsigned threads);

}  // namespace cartwright
