#include "host/relay/relay_match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/model/plant.hpp"
#include "host/statistics/autocorrelation.hpp"

namespace cartwright {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, kRelayValues>;

constexpr double kExact = 1e-12;  // of an amplitude: what positions are exact to, after some thousand steps

struct Window {
  std::size_t recording = 0;
  std::size_t first = 0, last = 0;
  double position_m = 0, velocity_m_per_s = 0;  ///< start state
};

/// Reduced to the common values: start state eliminated.
struct WindowFit {
  Eigen::VectorXd residual;  ///< measured less predicted, at the current start state
  Eigen::VectorXd reduced;   ///< the same, less what a better start state explains
  Columns slopes;            ///< by the common values, with the start state following
  Eigen::Matrix<double, 2, kRelayValues> follow;
  Eigen::Vector2d start_step;
};

Model model_of(const Eigen::Vector4d& values) {
  return Model(values(0))
      .set(Parameter::viscous_coefficient, values(1))
      .set(Parameter::coulomb_level, values(2))
      .set(Parameter::constant_acceleration, values(3));
}

Eigen::VectorXd replay(const Recording& recording, const Window& window, const Eigen::Vector4d& values,
                       double position_m, double velocity_m_per_s) {
  Plant plant(model_of(values));
  plant.reset(position_m, velocity_m_per_s, recording.t_s[window.first]);
  Eigen::VectorXd y(static_cast<Eigen::Index>(window.last - window.first));
  for (std::size_t row = window.first; row < window.last; ++row) {
    y(static_cast<Eigen::Index>(row - window.first)) = plant.state().position_m;
    plant.advance(recording.u_V[row], recording.t_s[row + 1] - recording.t_s[row]);
  }
  return y;
}

Eigen::VectorXd residual(const Recording& recording, const Window& window, const Eigen::Vector4d& values) {
  const auto count = static_cast<Eigen::Index>(window.last - window.first);
  return Eigen::Map<const Eigen::VectorXd>(recording.y_m.data() + window.first, count) -
         replay(recording, window, values, window.position_m, window.velocity_m_per_s);
}

/// Steps of the central differences: small against what the values do over a cycle, large against rounding.
Eigen::Vector4d difference_steps(const Eigen::Vector4d& values, double speed) {
  const double acceleration = std::abs(values(1)) * speed + std::abs(values(2));
  return {1e-4 * std::abs(values(0)), 1e-4 * acceleration / speed, 1e-4 * acceleration, 1e-4 * acceleration};
}

WindowFit linearise(const Recording& recording, const Window& window, const Eigen::Vector4d& values,
                    double speed) {
  WindowFit fit;
  fit.residual = residual(recording, window, values);
  const Eigen::Index rows = fit.residual.size();
  Columns by_value(rows, kRelayValues);
  const Eigen::Vector4d steps = difference_steps(values, speed);
  for (Eigen::Index k = 0; k < kRelayValues; ++k) {
    Eigen::Vector4d up = values, down = values;
    up(k) += steps(k);
    down(k) -= steps(k);
    by_value.col(k) = (replay(recording, window, up, window.position_m, window.velocity_m_per_s) -
                       replay(recording, window, down, window.position_m, window.velocity_m_per_s)) /
                      (2 * steps(k));
  }
  const double dv = 1e-4 * speed;
  Eigen::Matrix<double, Eigen::Dynamic, 2> by_start(rows, 2);
  by_start.col(0).setOnes();  // nothing depends on the position itself
  by_start.col(1) = (replay(recording, window, values, window.position_m, window.velocity_m_per_s + dv) -
                     replay(recording, window, values, window.position_m, window.velocity_m_per_s - dv)) /
                    (2 * dv);
  const Eigen::Matrix2d inverse = (by_start.transpose() * by_start).inverse();
  fit.follow = -inverse * (by_start.transpose() * by_value);
  fit.start_step = inverse * (by_start.transpose() * fit.residual);
  fit.slopes = by_value + by_start * fit.follow;
  fit.reduced = fit.residual - by_start * fit.start_step;
  return fit;
}

/// Velocity at the start of a window and mean speed within it, by straight lines.
double slope_at(const Recording& recording, std::size_t first, std::size_t last) {
  const std::size_t rows = std::min<std::size_t>(20, last - first);
  return (recording.y_m[first + rows - 1] - recording.y_m[first]) /
         (recording.t_s[first + rows - 1] - recording.t_s[first]);
}

/// First guess, linear in beta, c, F, g: the position of each window as its start state plus double integrals
/// of voltage, position and direction of motion.
Eigen::Vector4d first_guess(const std::vector<RelayRecording>& recordings,
                            const std::vector<Window>& windows) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const Window& window : windows) {
    const Recording& r = *recordings[window.recording].recording;
    const auto rows = static_cast<Eigen::Index>(window.last - window.first);
    Columns x(rows, kRelayValues);
    Eigen::Matrix<double, Eigen::Dynamic, 2> start(rows, 2);
    Eigen::VectorXd y(rows);
    Eigen::Vector4d first = Eigen::Vector4d::Zero(), second = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < rows; ++i) {
      const std::size_t row = window.first + static_cast<std::size_t>(i);
      y(i) = r.y_m[row];
      x.row(i) = second;
      start.row(i) << 1, r.t_s[row] - r.t_s[window.first];
      const double h = r.t_s[row + 1] - r.t_s[row];
      const std::size_t before = row < 10 ? 0 : row - 10, after = std::min(row + 10, r.size() - 1);
      const double move = r.y_m[after] - r.y_m[before];
      // Integrals of (u, -v, -sgn v, 1): the second one is known without integrating.
      const Eigen::Vector4d rate(r.u_V[row], 0, move > 0 ? -1 : 1, 1);
      second += h * first + 0.5 * h * h * rate;
      first += h * rate;
      second(1) -= h * (r.y_m[row] - r.y_m[window.first]);
    }
    const Eigen::Matrix2d inverse = (start.transpose() * start).inverse();
    x -= start * (inverse * (start.transpose() * x));
    y -= start * (inverse * (start.transpose() * y));
    normal += x.transpose() * x;
    right += x.transpose() * y;
  }
  Eigen::Vector4d guess = normal.ldlt().solve(right);
  guess(1) = std::max(guess(1), 1e-3);
  guess(2) = std::max(guess(2), 0.0);
  return guess;
}

class Match {
 public:
  explicit Match(const std::vector<RelayRecording>& recordings) : recordings_(recordings) {
    double path = 0, time = 0;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      const Recording& r = *recordings[i].recording;
      for (const Cycle& cycle : recordings[i].cycle.cycles) {
        Window window{i, cycle.first, cycle.last, r.y_m[cycle.first], slope_at(r, cycle.first, cycle.last)};
        windows_.push_back(window);
        path += 4 * cycle.amplitude_m;
        time += cycle.period_s;
        rounding_ += static_cast<double>(cycle.last - cycle.first) * std::pow(kExact * cycle.amplitude_m, 2);
      }
    }
    speed_ = path / time;
    weights_.assign(recordings.size(), 1.0);
    values_ = first_guess(recordings, windows_);
  }

  bool run() {
    // Once with equal weights, then with each recording weighted by what it leaves.
    for (int round = 0; round < 2; ++round) {
      if (!minimise()) return false;
      if (!coulomb_held_ && values_(2) < 0) {
        coulomb_held_ = true;
        values_(2) = 0;
        if (!minimise()) return false;
      }
      const auto rms = rms_per_recording();
      const double best = *std::max_element(rms.begin(), rms.end());
      for (std::size_t i = 0; i < rms.size(); ++i) {
        weights_[i] = best > 0 ? std::pow(best / std::max(rms[i], 0.1 * best), 2) : 1.0;
      }
    }
    return values_.allFinite();
  }

  RelayMatch result() const;

 private:
  const Recording& recording_of(const Window& window) const {
    return *recordings_[window.recording].recording;
  }

  double cost(const std::vector<Window>& windows, const Eigen::Vector4d& values) const {
    double sum = 0;
    for (const Window& w : windows)
      sum += weights_[w.recording] * residual(recording_of(w), w, values).squaredNorm();
    return sum;
  }

  Eigen::Vector4d solve(Eigen::Matrix4d normal, Eigen::Vector4d right) const {
    if (coulomb_held_) {
      normal.row(2).setZero();
      normal.col(2).setZero();
      normal(2, 2) = 1;
      right(2) = 0;
    }
    const Eigen::Vector4d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix4d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    return scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(right)));
  }

  bool minimise() {
    double now = cost(windows_, values_);
    for (int iteration = 0; iteration < 40; ++iteration) {
      std::vector<WindowFit> fits;
      fits.reserve(windows_.size());
      Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
      Eigen::Vector4d right = Eigen::Vector4d::Zero();
      for (const Window& w : windows_) {
        fits.push_back(linearise(recording_of(w), w, values_, speed_));
        normal += weights_[w.recording] * fits.back().slopes.transpose() * fits.back().slopes;
        right += weights_[w.recording] * fits.back().slopes.transpose() * fits.back().reduced;
      }
      const Eigen::Vector4d step = solve(normal, right);
      bool lower = false;
      double fall = 0;
      for (double part = 1; part > 1e-3 && !lower; part *= 0.5) {
        const Eigen::Vector4d next_values = values_ + part * step;
        std::vector<Window> next = windows_;
        for (std::size_t i = 0; i < next.size(); ++i) {
          const Eigen::Vector2d move = part * (fits[i].start_step + fits[i].follow * step);
          next[i].position_m += move(0);
          next[i].velocity_m_per_s += move(1);
        }
        const double then = cost(next, next_values);
        lower = then < now;
        if (lower) {
          fall = now - then;
          now = then;
          values_ = next_values;
          windows_ = std::move(next);
        }
      }
      if (!lower || fall < 1e-9 * now || now < rounding_) return values_.allFinite();
    }
    return false;
  }

  std::vector<double> rms_per_recording() const {
    std::vector<double> sum(recordings_.size(), 0.0), rows(recordings_.size(), 0.0);
    for (const Window& w : windows_) {
      const Eigen::VectorXd e = residual(recording_of(w), w, values_);
      sum[w.recording] += e.squaredNorm();
      rows[w.recording] += static_cast<double>(e.size());
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = rows[i] > 0 ? std::sqrt(sum[i] / rows[i]) : 0.0;
    return sum;
  }

  const std::vector<RelayRecording>& recordings_;
  std::vector<Window> windows_;
  std::vector<double> weights_;
  Eigen::Vector4d values_;
  double speed_ = 1;
  double rounding_ = 0;  ///< a cost that is only rounding; below it every step finds some of it to remove
  bool coulomb_held_ = false;
};

/// Correlation of one cycle's residual with the next one's, over their common rows.
double repeats(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::Index rows = std::min(a.size(), b.size());
  const double scale = a.head(rows).norm() * b.head(rows).norm();
  return scale > 0 ? a.head(rows).dot(b.head(rows)) / scale : 0.0;
}

RelayMatch Match::result() const {
  RelayMatch out;
  out.values = values_;
  out.coulomb_at_zero = coulomb_held_;
  out.mean_speed_m_per_s = speed_;
  out.rms_m = rms_per_recording();
  for (const RelayRecording& r : recordings_) {
    out.predicted_m.emplace_back(r.recording->size(), std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero(), scatter = Eigen::Matrix4d::Zero(),
                  common = Eigen::Matrix4d::Zero();
  Eigen::VectorXd before;
  for (std::size_t i = 0; i < windows_.size(); ++i) {
    const Window& w = windows_[i];
    const WindowFit fit = linearise(recording_of(w), w, values_, speed_);
    const double weight = weights_[w.recording];
    const Eigen::Matrix4d own = weight * fit.slopes.transpose() * fit.slopes;
    const Eigen::Vector4d score = weight * fit.slopes.transpose() * fit.reduced;
    normal += own;
    scatter += score * score.transpose();
    // What repeats acts on all cycles of its recording alike.
    const double cycles = static_cast<double>(recordings_[w.recording].cycle.cycles.size());
    const bool same = i > 0 && windows_[i - 1].recording == w.recording;
    const double again = same ? std::clamp(repeats(before, fit.reduced) - 0.1, 0.0, 1.0) : 0.0;
    const double variance = fit.reduced.squaredNorm() / static_cast<double>(fit.reduced.size());
    common += weight * variance * errors_per_independent_one(fit.reduced) * again * cycles * own;
    before = fit.reduced;
    auto& predicted = out.predicted_m[w.recording];
    for (std::size_t row = w.first; row < w.last; ++row) {
      predicted[row] = recording_of(w).y_m[row] - fit.residual(static_cast<Eigen::Index>(row - w.first));
    }
  }
  Eigen::Matrix4d inverse;
  for (Eigen::Index k = 0; k < kRelayValues; ++k) inverse.col(k) = solve(normal, Eigen::Vector4d::Unit(k));
  if (coulomb_held_) inverse.row(2).setZero();
  const double cycles = static_cast<double>(windows_.size());
  out.degrees = std::max(1.0, cycles - kRelayValues);
  out.covariance = inverse * (scatter * (cycles / out.degrees) + common) * inverse.transpose();
  if (coulomb_held_) {
    // How far above zero the level could be, were it free.
    out.covariance(2, 2) = scatter(2, 2) * (cycles / out.degrees) / (normal(2, 2) * normal(2, 2));
  }
  return out;
}

}  // namespace

Result<RelayMatch> match_limit_cycles(const std::vector<RelayRecording>& recordings) {
  std::size_t cycles = 0;
  for (const RelayRecording& r : recordings) cycles += r.cycle.cycles.size();
  if (cycles < 5) return failure("too few cycles to match; at least five are needed");
  Match match(recordings);
  if (!match.run())
    return failure("the stick-slip model does not match the limit cycles: the fit does not converge");
  return match.result();
}

}  // namespace cartwright
