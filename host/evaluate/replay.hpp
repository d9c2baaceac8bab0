#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/model/model.hpp"
#include "host/session/motion_range.hpp"
#include "host/session/session.hpp"

namespace cartwright {

struct ReplayOptions {
  double window_s = 0.5;             ///< length of the windows, by the recorded times
  double step_s = 1.5e-3;            ///< greatest inner step of the plant; stiff models choose a finer one
  std::size_t open_loop_rows = 20;   ///< rows that give the start state of the open loop
  int iterations = 12;               ///< most Gauss-Newton steps for one start state
  bool linear_by_steps = false;      ///< of two masses, as PlantOptions::linear_by_steps: faster
  std::optional<double> started_s;   ///< when the recording began, where only a part of it is replayed
  std::optional<MotionRange> range;  ///< of the recording, where that is replayed often
};

/// How the model moved during a replay.
struct ReplayedMotion {
  std::vector<double> velocity_m_per_s;  ///< at every row; exactly zero while the cart sticks
  std::vector<double> direction;         ///< mean of sgn v from each row to the next
  std::vector<double> moving_share;      ///< share of that time in which the cart does not stick
};

/// The recorded voltage replayed on a model over consecutive windows. In each window the start state (y0, v0)
/// of the cart is the one that minimises the squared position error of that window (Gauss-Newton with a step
/// guard, from several starts where the cart may stand); what else the model holds at that moment (voltages
/// on their way through a delay, armature, bristle, the motor's place in a backlash) is what the window
/// before left, and rest at the start of a recording or after a gap. Windows never cross a gap.
///
/// Returns the predicted reading [m] of every row, not rounded to counts; NaN in stretches of fewer than four
/// rows (and so is `motion`, where asked for). Depends on its arguments alone and may be called from several
/// threads.
std::vector<double> replay_windows(const Model& model, const Recording& recording,
                                   const ReplayOptions& options = {}, ReplayedMotion* motion = nullptr);

/// The recorded voltage replayed from the start of the recording (and again after each gap), the start state
/// fitted in the same way to the first `open_loop_rows` rows. Returns the predicted reading of every row; NaN
/// where a stretch has no more rows than those.
std::vector<double> replay_open_loop(const Model& model, const Recording& recording,
                                     const ReplayOptions& options = {});

/// Sum of squares and number of the rows that both have a value.
struct SquaredError {
  double sum_m2 = 0;
  std::size_t rows = 0;

  void add(double predicted_m, double measured_m);
  void add(const SquaredError& other);
  double rms_m() const;  ///< NaN for no rows
};

SquaredError squared_error(std::span<const double> predicted_m, std::span<const double> measured_m);

/// As above, leaving out the first `open_loop_rows` rows of each stretch, which gave the start state.
SquaredError open_loop_error(std::span<const double> predicted_m, const Recording& recording,
                             const ReplayOptions& options = {});

}  // namespace cartwright
