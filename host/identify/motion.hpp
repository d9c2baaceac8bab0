#pragma once

#include <vector>

#include "host/session/segments.hpp"
#include "host/session/session.hpp"

namespace cartwright {

struct MotionOptions {
  double smoothing_s = 8e-3;  ///< half width of the local quadratic that gives the velocity
  double stuck_s = 12e-3;     ///< half width of the stretch that must show movement
  double stuck_counts = 2.2;  ///< less movement than this within that stretch counts as standing still
};

/// Speed and direction, row by row.
struct Velocity {
  std::vector<double> at_m_per_s;    ///< at every row; used for signs and shapes, never differentiated
  std::vector<double> direction;     ///< mean of sgn v from a row to the next
  std::vector<double> moving_share;  ///< share of that time in which the cart does not stick
};

/// What a recording says about the cart's movement.
struct Motion {
  Velocity velocity;
  std::vector<Segment> moving;  ///< rows without a gap and without standing still
};

/// Size of one count as the readings show it: the rig's resolution, or what the noise of the readings amounts
/// to where that is larger or the rig does not say.
double reading_step_m(const Recording& recording, const Rig& rig);

/// Velocity by a least-squares quadratic over +-smoothing_s, and the stretches in which the cart moves. A
/// cart that sticks carries no information on friction (it equals the applied force), so those rows belong to
/// no stretch.
Motion motion_of(const Recording& recording, const Rig& rig, const MotionOptions& options = {});

/// Only the velocity, for readings without noise (a simulated twin).
Velocity velocity_of(const std::vector<double>& t_s, const std::vector<double>& y_m,
                     const MotionOptions& options = {});

}  // namespace cartwright
