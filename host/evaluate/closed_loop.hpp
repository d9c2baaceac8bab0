#pragma once

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright {

struct ClosedLoopOptions {
  bool quantise = true;            ///< the controller sees the encoder's resolution; off: the exact position
  std::uint64_t encoder_seed = 1;  ///< for missed counts
};

/// Runs a recording's own controller and reference on a model, tick by tick at the recorded times: the
/// controller reads y at t_k, its command holds until t_(k+1). Starts at rest at the first recorded position.
/// Where rows are lost the controller goes on ticking with the reference and the added voltage of the last
/// row, the best that is known; over ticks that it missed itself (column missed_ticks) the command holds.
///
/// Returns the recording with `y_m` and `u_V` replaced and `truth_y_m`, `truth_v_m_per_s` added. A recording
/// without a controller is run from its recorded voltage.
Recording simulate(const Model& model, const Rig& rig, const Recording& recording,
                   const ClosedLoopOptions& options = {});

}  // namespace cartwright
