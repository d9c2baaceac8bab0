#pragma once

#include <Eigen/Dense>
#include <vector>

#include "host/identify/identify.hpp"
#include "host/identify/shape_search.hpp"

namespace cartwright {

/// One recording, prepared: its windows and the left side, which no model changes.
struct Prepared {
  const Recording* recording;
  Motion motion;
  std::vector<Window> windows;
  Eigen::VectorXd response;
};

/// Least squares with the coefficients that may not be negative; near-null directions are left out of the
/// solution.
struct Linear {
  Eigen::VectorXd theta;
  std::vector<bool> at_bound;
  Eigen::MatrixXd null_directions;  ///< one per column, in scaled coefficients
  double cost = 0;
};

/// A session prepared for regression on the columns of a set of terms. Keeps references to all three
/// arguments.
class Problem {
 public:
  Problem(const Session& session, const TermSet& terms, const IdentifyOptions& options);

  std::size_t windows() const;
  const DataRange& range() const { return range_; }
  const std::vector<Prepared>& prepared() const { return prepared_; }

  /// Weak means of all columns per recording, for given shapes.
  std::vector<Eigen::MatrixXd> all_columns(const Model& shape) const;

  Linear least_squares(const std::vector<Eigen::MatrixXd>& X) const;

  /// Replaces the smoothed velocities by those of the model, replayed over short windows with fitted start
  /// states, wherever that replay stays within a count of the readings.
  void take_velocities(const Model& model);

  /// The same data and velocities in windows of another length.
  Problem with_window(double window_s) const;

  /// Columns of the noise-free closed loop where it stays with the recording, else the recording's own (`X`).
  std::vector<Eigen::MatrixXd> instruments(const Model& model, const std::vector<Eigen::MatrixXd>& X,
                                           std::size_t& twins) const;

 private:
  void place(double window_s);
  void extend_range(const Recording& recording, const Motion& motion);

  const Session* session_;
  const TermSet* terms_;
  const IdentifyOptions* options_;
  DataRange range_;
  std::vector<Prepared> prepared_;
};

}  // namespace cartwright
