#pragma once

#include <Eigen/Dense>
#include <vector>

#include "host/identify/bump.hpp"
#include "host/session/segments.hpp"

namespace cartwright {

struct WeakFormOptions {
  double window_s = 0.1;  ///< whole length of a window
  double least_share =
      0.5;            ///< a stretch shorter than a window still gives one, down to this share of its length
  double hop = 0.25;  ///< distance between windows, as a share of their length
};

/// A test function and the rows [first, last) it reaches.
struct Window {
  Bump bump;
  std::size_t first = 0, last = 0;
};

/// Windows that lie wholly within the given stretches, so that they cross neither gaps nor standstill.
std::vector<Window> place_windows(const std::vector<double>& t_s, const std::vector<Segment>& stretches,
                                  const WeakFormOptions& options);

/// The left side of the weak form, integral p y'' dt [m/s^2 once divided by the area of the bump], per
/// window. With p the straight-line interpolation of the bump between the rows, integrating by parts leaves a
/// sum over the readings that is exact: no moment of position or velocity leaks in, whatever the jitter, and
/// nothing is lost between rows.
Eigen::VectorXd weak_acceleration(const std::vector<Window>& windows, const std::vector<double>& t_s,
                                  const std::vector<double>& y_m);

/// The right side: integral p g dt, with the same p and the same division, for every column of
/// `interval_means`
/// ((rows - 1) x columns, the means of g between rows). Exact for what is constant between rows, as the held
/// voltage.
Eigen::MatrixXd weak_means(const std::vector<Window>& windows, const std::vector<double>& t_s,
                           const Eigen::MatrixXd& interval_means);

}  // namespace cartwright
