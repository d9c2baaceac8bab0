#include "host/evaluate/closed_loop.hpp"

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"
#include "host/evaluate/control_law.hpp"
#include "host/session/gaps.hpp"

namespace cartwright {
namespace {

/// A longer gap, hours, is no loss of rows but two recordings in one file.
constexpr double kMostTicksInAGap = 1e7;

/// How many ticks the controller made between `row` and the next one without leaving rows: none where it
/// missed them, which holds the command, and those of lost rows otherwise.
std::vector<std::size_t> ticks_after(const Recording& recording) {
  std::vector<std::size_t> ticks(recording.size(), 0);
  const auto missed = recording.other_columns.find("missed_ticks");
  for (const Gap& gap : find_gaps(recording.t_s)) {
    const bool held = missed != recording.other_columns.end() && missed->second[gap.row] >= gap.lost_ticks;
    if (!held && gap.lost_ticks <= kMostTicksInAGap)
      ticks[gap.row - 1] = static_cast<std::size_t>(gap.lost_ticks);
  }
  return ticks;
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
  ControlLaw law(rig, recording);
  const std::vector<std::size_t> lost_ticks = ticks_after(recording);
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
    if (row + 1 == out.size()) break;
    const double step_s = (out.t_s[row + 1] - out.t_s[row]) / static_cast<double>(lost_ticks[row] + 1);
    plant.advance(out.u_V[row], step_s);
    for (std::size_t tick = 0; tick < lost_ticks[row]; ++tick) {
      const PlantState& between = plant.state();
      plant.advance(law.command_V(row, encoder.read(between.position_m, between.velocity_m_per_s, step_s)),
                    step_s);
    }
  }
  return out;
}

}  // namespace cartwright
