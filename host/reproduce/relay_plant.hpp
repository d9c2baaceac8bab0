#pragma once

#include <utility>
#include <vector>

#include "host/evaluate/closed_loop.hpp"

namespace cartwright::reproduce {

/// The plant of the relay paper, Eq. (18): Kp = 10, Tp = 0.2685 s, f1 = 0.5 V, f2 = 0.01 V s/m.
struct PaperPlant {
  static constexpr double kKp = 10, kTp_s = 0.2685, kF1_V = 0.5, kF2 = 0.01;
  static Model model() {
    return Model(kKp / kTp_s)
        .set(Parameter::viscous_coefficient, (1 + kKp * kF2) / kTp_s)
        .set(Parameter::coulomb_level, kF1_V * kKp / kTp_s);
  }
};

/// A session of dual-relay experiments about zero on a model, started at rest.
inline Session relay_session(const Model& model, const std::vector<std::pair<double, double>>& amplitudes_V,
                             Rig rig, double length_s = 10, double start_m = 0) {
  Session session{rig, {}};
  for (const auto& [h1_V, h2_V] : amplitudes_V) {
    Recording recording;
    recording.file = "relay_" + std::to_string(session.recordings.size() + 1) + ".csv";
    recording.experiment = "relay";
    recording.controller = DualRelayGains{h1_V, h2_V, 0};
    const auto rows = static_cast<std::size_t>(length_s * rig.sample_rate_hz);
    for (std::size_t row = 0; row < rows; ++row) {
      recording.t_s.push_back(static_cast<double>(row) / rig.sample_rate_hz);
    }
    recording.y_m.assign(rows, start_m);
    recording.u_V.assign(rows, 0);
    recording.r_m.assign(rows, 0);
    session.recordings.push_back(simulate(model, rig, recording));
  }
  return session;
}

inline Rig rig_with(double sample_rate_hz, double encoder_resolution_m) {
  Rig rig;
  rig.sample_rate_hz = sample_rate_hz;
  rig.encoder_resolution_m = encoder_resolution_m;
  return rig;
}

}  // namespace cartwright::reproduce
