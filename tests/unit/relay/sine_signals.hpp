#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

namespace cartwright::test {

/// A sampled sine with everything a real record adds to it.
struct SineSignal {
  double amplitude = 1, frequency_hz = 1, phase_rad = 0, offset = 0;
  double trend_per_s = 0, third_harmonic = 0;
  double start_s = 0, period_s = 0.005, jitter_s = 0;
  double noise = 0, noise_pole = 0;  ///< standard deviation; pole of a first-order colouring filter
  double step = 0;                   ///< quantisation
  int samples = 401;

  struct Data {
    std::vector<double> t_s, y;
  };
  template <typename Random>
  Data draw(Random& random) const {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> late(0, 1);
    Data data;
    double coloured = noise_pole > 0 ? normal(random) : 0;
    const double w = 2 * std::numbers::pi * frequency_hz, fresh = std::sqrt(1 - noise_pole * noise_pole);
    for (int i = 0; i < samples; ++i) {
      const double t = start_s + period_s * i + (jitter_s > 0 ? jitter_s * late(random) : 0);
      const double sine = std::sin(w * t + phase_rad);
      if (noise > 0) coloured = noise_pole * coloured + fresh * normal(random);
      // sin 3a = 3 sin a - 4 sin^3 a
      double y = offset + amplitude * sine + trend_per_s * t + third_harmonic * sine * (3 - 4 * sine * sine) +
                 noise * coloured;
      if (step > 0) y = step * std::round(y / step);
      data.t_s.push_back(t);
      data.y.push_back(y);
    }
    return data;
  }
};

/// Signals that a test of random ones draws: as many as usual, or what CARTWRIGHT_SINEFIT_DRAWS says.
inline int draws(int usual) {
  const char* wanted = std::getenv("CARTWRIGHT_SINEFIT_DRAWS");
  return wanted == nullptr ? usual : std::atoi(wanted);
}

/// Difference of two angles in (-pi, pi].
inline double angle_between(double a, double b) {
  return std::remainder(a - b, 2 * std::numbers::pi);
}

}  // namespace cartwright::test
