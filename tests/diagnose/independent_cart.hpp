#pragma once

#include <cstdint>
#include <functional>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright::test {

/// A cart for concealed physics, written without the product's plant: explicit Euler at 20 us, friction that
/// holds a cart still by comparing forces, whatever else as functions. Otherwise a diagnosis would only prove
/// that a formula equals itself.
struct IndependentCart {
  double gain_m_per_s2_V = 1.9, viscous_per_s = 5, coulomb_m_per_s2 = 0.4;
  std::function<double(double u_V)> amplifier = [](double u) { return u; };
  std::function<double(double t_s, double y_m, double v_m_per_s)> push = [](double, double, double) {
    return 0.0;
  };
  std::function<double(double t_s, double y_m, double v_m_per_s, double u_V)> extra_level =
      [](double, double, double, double) { return 0.0; };
  std::function<double(double y_m)> encoder_error_m = [](double) { return 0.0; };
  int delay_ticks = 0;
  double sample_rate_hz = 1000, count_m = 2.275e-5;
  double reading_noise_counts = 0.22, disturbance_m_per_s2 = 0.02;
  double noise = 1;    ///< share of these two; without, readings are only rounded
  double start_m = 0;  ///< between two counts it is off for the diagnosis
  std::uint64_t seed = 1;
};

/// A short battery on that cart: three repeats of a step, two relays, two tracks and a dither, 4 s each, with
/// an encoder that rounds, its noise, a small coloured disturbance and jittering ticks.
Session battery(const IndependentCart& cart);

/// Five recordings of positioning moves, the cart at rest two thirds of the time.
Session moves(const IndependentCart& cart);

/// What an engineer would have of it: values a few per cent off.
Model nominal(double gain_m_per_s2_V = 1.87, double viscous_per_s = 5.2, double coulomb_m_per_s2 = 0.41);

}  // namespace cartwright::test
