#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "host/evaluate/closed_loop.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// The usual cart of these tests.
inline Model cart(double coulomb_level = 0.5) {
  return Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, coulomb_level);
}

/// Recordings of a simulated cart for tests: the session's own control laws on a model, with an encoder.
class SimulatedSession {
 public:
  explicit SimulatedSession(Model model) : model_(std::move(model)) {
    session_.rig.encoder_resolution_m = 2.275e-5;
    session_.rig.travel_m = {-2, 2};
  }

  Rig& rig() { return session_.rig; }

  /// Reference r(t) under a PD controller; `jitter_s` moves every tick.
  template <typename Reference>
  SimulatedSession& add(std::string file, PdGains gains, double duration_s, Reference&& reference,
                        double jitter_s = 1e-5) {
    Recording recording;
    recording.file = std::move(file);
    recording.experiment = "track";
    recording.controller = gains;
    const auto rows = static_cast<std::size_t>(std::round(duration_s * session_.rig.sample_rate_hz));
    for (std::size_t row = 0; row < rows; ++row) {
      const double tick = static_cast<double>(row);
      const double t_s = tick * session_.rig.period_s() + jitter_s * std::abs(std::sin(12.9898 * tick));
      recording.t_s.push_back(t_s);
      recording.r_m.push_back(reference(t_s));
    }
    recording.y_m.assign(rows, 0.0);
    recording.u_V.assign(rows, 0.0);
    session_.recordings.push_back(simulate(model_, session_.rig, recording));
    return *this;
  }

  /// A step to 0.1 m and a multisine, which together excite everything.
  SimulatedSession& add_usual(int repeats = 1) {
    for (int i = 0; i < repeats; ++i) {
      const std::string number = std::to_string(i);
      add("step_" + number + ".csv", {60, 0}, 1.5, [](double) { return 0.1; });
      add("track_" + number + ".csv", {80, 2}, 4, [i](double t_s) {
        double sum = 0;
        for (const double f_hz : {0.4, 1.1, 2.3, 3.7}) {
          sum += 0.03 * std::sin(2 * std::numbers::pi * f_hz * t_s + 0.7 * i + f_hz);
        }
        return sum;
      });
    }
    return *this;
  }

  const Session& get() const { return session_; }
  Session& edit() { return session_; }

 private:
  Model model_;
  Session session_;
};

}  // namespace cartwright
