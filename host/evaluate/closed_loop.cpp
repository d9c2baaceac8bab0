#include "host/evaluate/closed_loop.hpp"

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"
#include "host/evaluate/control_law.hpp"

namespace cartwright {
Recording simulate(const Model& model, const Rig& rig, const Recording& recording,
                   const ClosedLoopOptions& options) {
  PlantOptions plant_options;
  plant_options.disturbance_active = model.disturbance_recording == recording.file;
  plant_options.heating_start_s = recording.t_s.front();
  Plant plant(model, plant_options);
  plant.reset(recording.y_m.front(), 0, recording.t_s.front());
  Encoder encoder(model, options.quantise ? rig.encoder_resolution_m : 0, options.encoder_seed);
  Recording out = recording;
  ControlLaw law(rig, recording);
  auto& truth_y = out.other_columns["truth_y_m"];
  auto& truth_v = out.other_columns["truth_v_m_per_s"];
  truth_y.resize(out.size());
  truth_v.resize(out.size());
  for (std::size_t row = 0; row < out.size(); ++row) {
    const PlantState& state = plant.state();
    const double elapsed = row == 0 ? 0 : out.t_s[row] - out.t_s[row - 1];
    truth_y[row] = state.position_m;
    truth_v[row] = state.velocity_m_per_s;
    out.y_m[row] = encoder.read(state.position_m, state.velocity_m_per_s, elapsed);
    out.u_V[row] = law.command_V(row, out.y_m[row]);
    if (row + 1 < out.size()) plant.advance(out.u_V[row], out.t_s[row + 1] - out.t_s[row]);
  }
  return out;
}

}  // namespace cartwright
