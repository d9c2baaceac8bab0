#pragma once

#include <Eigen/Dense>
#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// Means over one short window of a recording.
struct DriveWindow {
  std::size_t recording = 0;
  std::size_t first = 0, last = 0;  ///< rows; the window ends at the time of `last`
  double drive_V = 0;               ///< the voltage held over each tick
  double position_m = 0;
  double speed_m_per_s = 0;
  double acceleration_m_per_s2 = 0;  ///< from the speeds around its first row and its last
};

/// The windows of 50 ms in which the cart keeps moving at about its usual speed. Left out are those across a
/// gap in time, those in which it nearly stands (friction then takes up any drive) or is thrown, and their
/// neighbours.
std::vector<DriveWindow> drive_windows(const Session& session);

/// Means of sin(2 pi f y) and cos(2 pi f y) over each window: windows x 2.
Eigen::MatrixX2d waves_over(const std::vector<DriveWindow>& windows, const Session& session,
                            double frequency_per_m);

}  // namespace cartwright
