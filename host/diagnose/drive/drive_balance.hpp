#pragma once

#include <optional>
#include <vector>

#include "host/diagnose/drive/drive_windows.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

/// One line of the drive over the way: height sin(2 pi y/period + phase).
struct DriveLine {
  Estimate height_V, period_m, phase_rad;
  double gain = 0;  ///< log-likelihood that would be lost without it [nats]
};

/// What the drive of a session balances, where a servo keeps the speed.
///
/// Nothing then accelerates by what the drive could do, no model predicts more than that the speed stays, and
/// the voltage gain is not to be had from such data. But the drive itself is the measurement of what it
/// balances,
///
///     u = (friction - push(y) + d2y/dt2)/beta,
///
/// and what no term explains is in u, not in y. So u is the response of a least-squares regression of its
/// means over short windows on direction, speed, acceleration and lines over the way, all of them searched
/// for (drive_lines.hpp). Errors count by their autocorrelation: neighbouring windows are not independent.
struct DriveBalance {
  std::vector<DriveLine> lines;  ///< highest first; `held` of them in `predicted_V` and in what is left
  std::size_t held = 0;          ///< as many as a model holds
  double friction_V = 0;         ///< against the motion, at the mean of the speeds that were held
  /// Root mean square of what the drive balances besides friction, and of what the lines leave of it: in all
  /// windows, and in quarters of the way for which everything, the choice of the lines included, was done
  /// without them.
  double missing_V = 0, left_V = 0, unseen_missing_V = 0, unseen_left_V = 0;
  /// Log-likelihood by which the best line over time, with a phase of its own in each recording, is behind
  /// the best one over the way [nats]: at one speed the two are the same.
  double time_behind = 0;
  std::vector<DriveWindow> windows;
  std::vector<double> predicted_V;  ///< of each window

  /// Of the power that is missing in quarters of the way not seen, what is left.
  double share_left() const;
};

/// None where the session holds no speed or its drive has no line above chance.
std::optional<DriveBalance> drive_balance(const Session& session, unsigned threads);

}  // namespace cartwright
