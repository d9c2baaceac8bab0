#include "host/identify/problem.hpp"

#include <algorithm>
#include <cmath>

#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/replay.hpp"
#include "host/identify/quadratic_program.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Squared cosine below which columns, scaled to unit length, count as one: the data then tells their
/// combination only.
constexpr double kNearNull = 1e-7;
/// Greatest rms distance between a twin and its recording, as a share of the movement, for the twin to say
/// anything about that recording. A relay's limit cycle drifts out of phase; its twin is then of no use.
constexpr double kTwinDistance = 0.15;
constexpr double kFewestRowsInWindow = 24;
constexpr double kReplay_s = 0.15;
constexpr std::size_t kRowsJudged = 24;

MatrixXd columns(const TermSet& terms, const Model& shape, const Prepared& data) {
  return weak_means(data.windows, data.recording->t_s,
                    interval_means(terms, shape, *data.recording, data.recording->y_m, data.motion.velocity,
                                   data.recording->u_V));
}

Linear solve(const TermSet& terms, const MatrixXd& H, const VectorXd& g, double response_squared) {
  const Index size = H.rows();
  VectorXd scale(size);
  for (Index i = 0; i < size; ++i) scale[i] = H(i, i) > 0 ? 1 / std::sqrt(H(i, i)) : 0;
  const MatrixXd scaled = scale.asDiagonal() * H * scale.asDiagonal();
  const VectorXd right = scale.cwiseProduct(g);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const double floor = kNearNull * eigen.eigenvalues().maxCoeff();
  Index null = 0;
  while (null < size && eigen.eigenvalues()[null] < floor) ++null;
  Linear out;
  out.null_directions = eigen.eigenvectors().leftCols(null);
  out.at_bound.assign(static_cast<std::size_t>(size), false);
  // Null directions get unit stiffness around zero, so that the rest is solved as if they were not there.
  const MatrixXd firm = scaled + out.null_directions * out.null_directions.transpose();
  std::vector<Index> bounded;
  for (Index i = 0; i < size; ++i) {
    if (terms.nonnegative(terms.features()[static_cast<std::size_t>(i)])) bounded.push_back(i);
  }
  MatrixXd G = MatrixXd::Zero(static_cast<Index>(bounded.size()), size);
  for (std::size_t i = 0; i < bounded.size(); ++i) G(static_cast<Index>(i), bounded[i]) = 1;
  const QuadraticSolution solution = minimise(firm, right, G, VectorXd::Zero(G.rows()));
  for (std::size_t i = 0; i < bounded.size(); ++i) {
    out.at_bound[static_cast<std::size_t>(bounded[i])] = solution.multipliers[static_cast<Index>(i)] > 0;
  }
  out.theta = scale.cwiseProduct(solution.x);
  for (const Index i : bounded) {
    if (out.at_bound[static_cast<std::size_t>(i)]) out.theta[i] = 0;
  }
  out.cost = response_squared - 2 * g.dot(out.theta) + out.theta.dot(H * out.theta);
  return out;
}

}  // namespace

Problem::Problem(const Session& session, const TermSet& terms, const IdentifyOptions& options)
    : session_(&session), terms_(&terms), options_(&options) {
  for (const Recording& recording : session.recordings) {
    Prepared data{&recording, motion_of(recording, session.rig, options.motion), {}, {}};
    extend_range(recording, data.motion);
    prepared_.push_back(std::move(data));
  }
  place(options.weak.window_s);
}

void Problem::place(double window_s) {
  WeakFormOptions weak = options_->weak;
  weak.window_s = std::max(window_s, kFewestRowsInWindow * range_.period_s);
  for (Prepared& data : prepared_) {
    data.windows = place_windows(data.recording->t_s, data.motion.moving, weak);
    data.response = weak_acceleration(data.windows, data.recording->t_s, data.recording->y_m);
  }
}

Problem Problem::with_window(double window_s) const {
  Problem out = *this;
  out.place(window_s);
  return out;
}

std::size_t Problem::windows() const {
  std::size_t count = 0;
  for (const Prepared& data : prepared_) count += data.windows.size();
  return count;
}

std::vector<MatrixXd> Problem::all_columns(const Model& shape) const {
  std::vector<MatrixXd> out;
  for (const Prepared& data : prepared_) out.push_back(columns(*terms_, shape, data));
  return out;
}

Linear Problem::least_squares(const std::vector<MatrixXd>& X) const {
  const auto size = static_cast<Index>(terms_->features().size());
  MatrixXd H = MatrixXd::Zero(size, size);
  VectorXd g = VectorXd::Zero(size);
  double bb = 0;
  for (std::size_t i = 0; i < X.size(); ++i) {
    H.noalias() += X[i].transpose() * X[i];
    g.noalias() += X[i].transpose() * prepared_[i].response;
    bb += prepared_[i].response.squaredNorm();
  }
  return solve(*terms_, H, g, bb);
}

void Problem::take_velocities(const Model& model) {
  ReplayOptions replay;
  replay.window_s = kReplay_s;
  for (Prepared& data : prepared_) {
    const Recording& recording = *data.recording;
    ReplayedMotion moved;
    const std::vector<double> predicted_m = replay_windows(model, recording, replay, &moved);
    const double step_m = reading_step_m(recording, session_->rig);
    Velocity& velocity = data.motion.velocity;
    for (std::size_t first = 0; first < recording.size(); first += kRowsJudged) {
      const std::size_t last = std::min(first + kRowsJudged, recording.size());
      SquaredError error;
      for (std::size_t row = first; row < last; ++row) error.add(predicted_m[row], recording.y_m[row]);
      if (error.rows < last - first || error.rms_m() > step_m) continue;
      for (std::size_t row = first; row < last; ++row) {
        velocity.at_m_per_s[row] = moved.velocity_m_per_s[row];
        velocity.direction[row] = moved.direction[row];
        velocity.moving_share[row] = moved.moving_share[row];
      }
    }
  }
}

std::vector<MatrixXd> Problem::instruments(const Model& model, const std::vector<MatrixXd>& X,
                                           std::size_t& twins) const {
  std::vector<MatrixXd> out = X;
  ClosedLoopOptions exact;
  exact.quantise = false;
  twins = 0;
  for (std::size_t i = 0; i < prepared_.size(); ++i) {
    const Recording& recording = *prepared_[i].recording;
    if (!recording.has_controller() || prepared_[i].windows.empty()) continue;
    const Recording twin = simulate(model, session_->rig, recording, exact);
    double apart = 0, moved = 0;
    const double middle_m = 0.5 * (*std::min_element(recording.y_m.begin(), recording.y_m.end()) +
                                   *std::max_element(recording.y_m.begin(), recording.y_m.end()));
    for (std::size_t row = 0; row < twin.size(); ++row) {
      apart += (twin.y_m[row] - recording.y_m[row]) * (twin.y_m[row] - recording.y_m[row]);
      moved += (recording.y_m[row] - middle_m) * (recording.y_m[row] - middle_m);
    }
    if (!(apart < kTwinDistance * kTwinDistance * moved)) continue;
    out[i] = weak_means(prepared_[i].windows, recording.t_s,
                        interval_means(*terms_, model, recording, twin.y_m,
                                       velocity_of(twin.t_s, twin.y_m, options_->motion), twin.u_V));
    ++twins;
  }
  return out;
}

void Problem::extend_range(const Recording& recording, const Motion& motion) {
  const auto [least, most] = std::minmax_element(recording.y_m.begin(), recording.y_m.end());
  const bool first = prepared_.empty();
  range_.least_m = first ? *least : std::min(range_.least_m, *least);
  range_.most_m = first ? *most : std::max(range_.most_m, *most);
  range_.period_s = std::max(range_.period_s, median_period_s(recording.t_s));
  for (const double v : motion.velocity.at_m_per_s)
    range_.speed_m_per_s = std::max(range_.speed_m_per_s, std::abs(v));
  for (const double u : recording.u_V) range_.voltage_V = std::max(range_.voltage_V, std::abs(u));
  range_.longest_s = std::max(range_.longest_s, recording.t_s.back() - recording.t_s.front());
}

}  // namespace cartwright
