#include "host/evaluate/closed_loop.hpp"

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"

namespace cartwright {
namespace {

/// The recorded voltage where no control law is known.
struct RecordedVoltage {
  const Recording& recording;
  double operator()(std::size_t row, double) const { return recording.u_V[row]; }
};

template <typename Law>
struct Loop {
  const Recording& recording;
  Law law;
  double operator()(std::size_t row, double measured_m) {
    return law.update(recording.r_m[row], measured_m, recording.added_V(row));
  }
};

template <typename Command>
void run(Plant& plant, Encoder& encoder, Command&& command, Recording& out) {
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
    out.u_V[row] = command(row, out.y_m[row]);
    if (row + 1 < out.size()) plant.advance(out.u_V[row], out.t_s[row + 1] - out.t_s[row]);
  }
}

}  // namespace

Recording simulate(const Model& model, const Rig& rig, const Recording& recording,
                   const ClosedLoopOptions& options) {
  PlantOptions plant_options;
  plant_options.disturbance_active = model.disturbance_recording == recording.file;
  plant_options.heating_start_s = recording.t_s.front();
  Plant plant(model, plant_options);
  plant.reset(recording.y_m.front(), 0, recording.t_s.front());
  Encoder encoder(model, options.quantise ? rig.encoder_resolution_m : 0, options.encoder_seed);
  Recording out = recording;
  if (const auto* pd = std::get_if<PdGains>(&recording.controller)) {
    run(plant, encoder, Loop<PdController>{recording, {*pd, rig.period_s(), rig.voltage_limit_V}}, out);
  } else if (const auto* relay = std::get_if<DualRelayGains>(&recording.controller)) {
    run(plant, encoder, Loop<DualRelayController>{recording, {*relay, rig.period_s(), rig.voltage_limit_V}},
        out);
  } else {
    run(plant, encoder, RecordedVoltage{recording}, out);
  }
  return out;
}

}  // namespace cartwright
