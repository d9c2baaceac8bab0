#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "host/diagnose/drive/drive_windows.hpp"

namespace cartwright {

/// Some of a session's windows, by number.
using Rows = std::vector<Eigen::Index>;

/// Least squares of the drive of short windows [V] on what every cart has, direction, one, speed and
/// acceleration, and on lines over the way: sines of some frequency [1/m], which are searched for. Keeps a
/// reference to the session.
class DriveLines {
 public:
  DriveLines(const Session& session, unsigned threads);

  /// Whether there are windows enough, and way enough for a line.
  bool enough() const { return !grid_.empty(); }
  const std::vector<DriveWindow>& windows() const { return windows_; }
  const Eigen::VectorXd& drive_V() const { return drive_; }
  const Eigen::MatrixXd& base() const { return base_; }  ///< windows x 4
  bool both_ways() const { return both_ways_; }
  double travel_m() const { return travel_m_; }
  Rows all() const;

  /// The base and sine and cosine of each line: windows x (4 + 2 lines).
  Eigen::MatrixXd columns(const std::vector<double>& lines_per_m) const;
  Eigen::MatrixXd wave(double frequency_per_m) const;

  Eigen::VectorXd solution(const Rows& rows, const Eigen::MatrixXd& columns) const;
  /// What columns leave of the drive.
  Eigen::VectorXd errors(const Rows& rows, const Eigen::MatrixXd& columns) const;

  /// The lines above chance, highest first: as many as there might be are searched for, then those are taken
  /// out that gain less than an effect must.
  std::vector<double> find(const Rows& rows) const;

  /// What each line gains beside the others [nats].
  std::vector<double> gains(const Rows& rows, const std::vector<double>& lines_per_m) const;

 private:
  std::optional<double> next_line(const Rows& rows, const std::vector<double>& lines) const;
  void polish(const Rows& rows, std::vector<double>& lines) const;
  void put_highest_first(const Rows& rows, std::vector<double>& lines) const;

  const Session& session_;
  unsigned threads_;
  std::vector<DriveWindow> windows_;
  Eigen::VectorXd drive_;
  Eigen::MatrixXd base_;
  std::vector<double> grid_;            ///< frequencies looked at [1/m]
  std::vector<Eigen::MatrixXd> waves_;  ///< of these
  double travel_m_ = 0;
  bool both_ways_ = false;
};

/// A basis of the columns' span.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

}  // namespace cartwright
