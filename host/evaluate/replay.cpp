#include "host/evaluate/replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/model/encoder.hpp"
#include "common/model/plant.hpp"
#include "host/session/segments.hpp"

namespace cartwright {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kLeastRows = 4;
/// Trial changes for the sensitivities, of the travel and of the greatest speed: large enough that friction
/// does not swallow them, small against the motion.
constexpr double kTrialPosition = 3e-5;
constexpr double kTrialVelocity = 1e-3;
constexpr double kWide = 10;
/// Of the greatest speed: below it the cart may stand.
constexpr double kSlow = 0.05;

struct Start {
  double position_m = 0, velocity_m_per_s = 0;
};

/// Replays rows [first, last) from given start states and finds the best one.
class Replay {
 public:
  Replay(const Model& model, const Recording& recording, const ReplayOptions& options)
      : recording_(recording), options_(options), encoder_(model, 0) {
    plant_options_.step_s = options.step_s;
    plant_options_.linear_by_steps = options.linear_by_steps;
    plant_options_.disturbance_active = model.disturbance_recording == recording.file;
    plant_options_.heating_start_s = options.started_s.value_or(recording.t_s.front());
    const MotionRange range = options.range ? *options.range : motion_range_of({&recording, 1});
    if (range.travel_m() > 0) trial_position_m_ = kTrialPosition * range.travel_m();
    if (range.most_speed_m_per_s > 0) trial_velocity_m_per_s_ = kTrialVelocity * range.most_speed_m_per_s;
    slow_m_per_s_ = kSlow * range.most_speed_m_per_s;
  }

  Plant cold_plant(const Model& model, std::size_t row) const {
    Plant plant(model, plant_options_);
    plant.reset(recording_.y_m[row], 0, recording_.t_s[row]);
    return plant;
  }

  /// Predicts rows [first, last) and leaves `plant` at the time of row `last` (or of the last row, at the
  /// end).
  void run(Plant& plant, const Start& start, std::size_t first, std::size_t last, std::vector<double>& out_m,
           ReplayedMotion* motion = nullptr) const {
    plant.correct(start.position_m, start.velocity_m_per_s);
    out_m.resize(last - first);
    for (std::size_t row = first; row < last; ++row) {
      out_m[row - first] = encoder_.seen(plant.state().position_m);
      if (motion != nullptr) trace(plant, row, *motion);
      if (row + 1 < recording_.size())
        plant.advance(recording_.u_V[row], recording_.t_s[row + 1] - recording_.t_s[row]);
    }
  }

  /// The start state that fits rows [first, last) best from the data's own slope; of a cart that may stand
  /// also from standstill, and from where wide trials lead, which see over the kinks of friction.
  Start fit(const Plant& before, std::size_t first, std::size_t last) {
    const Start moving = slope(first, last);
    Start best = moving;
    double best_cost = refine(before, best, first, last);
    if (!may_stand(moving.velocity_m_per_s, first, last)) return best;
    Start still{moving.position_m, 0}, beyond_kinks = moving;
    refine(before, beyond_kinks, first, last, kWide);
    for (Start start : {still, beyond_kinks}) {
      const double cost = refine(before, start, first, last);
      if (cost < best_cost) best = start, best_cost = cost;
    }
    return best;
  }

  static void clear(ReplayedMotion& motion, std::size_t rows) {
    for (auto* column : {&motion.velocity_m_per_s, &motion.direction, &motion.moving_share})
      column->assign(rows, kNaN);
  }

 private:
  /// Signs within a row's hold are counted in this many parts where the cart stops or turns.
  static constexpr int kParts = 32;

  /// Notes how `plant`, at `row`, is going to move until the next row.
  void trace(const Plant& plant, std::size_t row, ReplayedMotion& motion) const {
    const auto sign = [](double v) { return v > 0 ? 1.0 : (v < 0 ? -1.0 : 0.0); };
    const double v0 = plant.state().velocity_m_per_s;
    motion.velocity_m_per_s[row] = v0;
    motion.direction[row] = sign(v0);
    motion.moving_share[row] = std::abs(sign(v0));
    if (row + 1 >= recording_.size()) return;
    const double hold_s = recording_.t_s[row + 1] - recording_.t_s[row];
    Plant ahead = plant;
    ahead.advance(recording_.u_V[row], hold_s);
    if (sign(ahead.state().velocity_m_per_s) == sign(v0) && v0 != 0) return;
    ahead = plant;
    double direction = 0, moving = 0;
    for (int part = 0; part < kParts; ++part) {
      const double before = sign(ahead.state().velocity_m_per_s);
      ahead.advance(recording_.u_V[row], hold_s / kParts);
      const double after = sign(ahead.state().velocity_m_per_s);
      direction += 0.5 * (before + after) / kParts;
      moving += 0.5 * (std::abs(before) + std::abs(after)) / kParts;
    }
    motion.direction[row] = direction;
    motion.moving_share[row] = moving;
  }

  static constexpr std::size_t kSlopeRows = 12;

  /// Straight line through the first rows, at the first row's time.
  Start slope(std::size_t first, std::size_t last) const {
    const std::size_t rows = std::min(kSlopeRows, last - first);
    const double count = static_cast<double>(rows);
    double t = 0, y = 0, tt = 0, ty = 0;
    for (std::size_t row = first; row < first + rows; ++row) {
      const double dt = recording_.t_s[row] - recording_.t_s[first];
      const double dy = recording_.y_m[row] - recording_.y_m[first];
      t += dt;
      y += dy;
      tt += dt * dt;
      ty += dt * dy;
    }
    const double velocity = (count * ty - t * y) / (count * tt - t * t);
    return {recording_.y_m[first] + (y - velocity * t) / count, velocity};
  }

  /// Slow against the recording, or seen to move by no more than one step between two readings.
  bool may_stand(double velocity_m_per_s, std::size_t first, std::size_t last) const {
    if (std::abs(velocity_m_per_s) <= slow_m_per_s_) return true;
    const std::vector<double>& y = recording_.y_m;
    const std::size_t end = first + std::min(kSlopeRows, last - first);
    double most_step_m = 0;
    for (std::size_t row = first + 1; row < end; ++row)
      most_step_m = std::max(most_step_m, std::abs(y[row] - y[row - 1]));
    return std::abs(y[end - 1] - y[first]) <= most_step_m;
  }

  double cost(const std::vector<double>& predicted_m, std::size_t first) const {
    double sum = 0;
    for (std::size_t i = 0; i < predicted_m.size(); ++i) {
      const double e = predicted_m[i] - recording_.y_m[first + i];
      sum += e * e;
    }
    return sum;
  }

  double try_start(const Plant& before, const Start& start, std::size_t first, std::size_t last,
                   std::vector<double>& out_m) {
    Plant plant = before;
    run(plant, start, first, last, out_m);
    return cost(out_m, first);
  }

  /// Gauss-Newton with Levenberg damping and forward differences; returns the squared error at the improved
  /// start. `trials` times the usual change is tried.
  double refine(const Plant& before, Start& start, std::size_t first, std::size_t last, double trials = 1) {
    const double dy = trials * trial_position_m_, dv = trials * trial_velocity_m_per_s_;
    double now = try_start(before, start, first, last, base_m_);
    double damping = 1e-6;
    for (int iteration = 0; iteration < options_.iterations; ++iteration) {
      try_start(before, {start.position_m + dy, start.velocity_m_per_s}, first, last, by_position_m_);
      try_start(before, {start.position_m, start.velocity_m_per_s + dv}, first, last, by_velocity_m_);
      double aa = 0, ab = 0, bb = 0, ar = 0, br = 0;
      for (std::size_t i = 0; i < base_m_.size(); ++i) {
        const double a = (by_position_m_[i] - base_m_[i]) / dy;
        const double b = (by_velocity_m_[i] - base_m_[i]) / dv;
        const double r = recording_.y_m[first + i] - base_m_[i];
        aa += a * a;
        ab += a * b;
        bb += b * b;
        ar += a * r;
        br += b * r;
      }
      bool improved = false;
      double fall = 0;
      for (int attempt = 0; attempt < 6 && !improved; ++attempt, damping *= 30) {
        const double da = aa * (1 + damping), db = bb * (1 + damping) + 1e-12;
        const double determinant = da * db - ab * ab;
        if (!(determinant > 0)) continue;
        const Start next{start.position_m + (db * ar - ab * br) / determinant,
                         start.velocity_m_per_s + (da * br - ab * ar) / determinant};
        const double then = try_start(before, next, first, last, trial_m_);
        if (then < now) {
          improved = true;
          fall = now - then;
          now = then;
          start = next;
          std::swap(base_m_, trial_m_);
        }
      }
      if (!improved || fall < 1e-4 * now) break;
      damping = std::max(damping * 1e-3, 1e-9);
    }
    return now;
  }

  const Recording& recording_;
  const ReplayOptions& options_;
  PlantOptions plant_options_;
  Encoder encoder_;
  /// Where no reading differs from another any will do.
  double trial_position_m_ = 1e-6, trial_velocity_m_per_s_ = 1e-3, slow_m_per_s_ = 0;
  std::vector<double> base_m_, trial_m_, by_position_m_, by_velocity_m_;
};

}  // namespace

std::vector<double> replay_windows(const Model& model, const Recording& recording,
                                   const ReplayOptions& options, ReplayedMotion* motion) {
  std::vector<double> out(recording.size(), kNaN), predicted;
  if (motion != nullptr) Replay::clear(*motion, recording.size());
  if (recording.size() == 0) return out;
  Replay replay(model, recording, options);
  for (const Segment& stretch : segments(recording.t_s)) {
    Plant plant = replay.cold_plant(model, stretch.first);
    std::size_t first = stretch.first;
    while (first < stretch.last) {
      const double end_s = recording.t_s[first] + options.window_s;
      std::size_t last = first;
      while (last < stretch.last && recording.t_s[last] < end_s) ++last;
      if (stretch.last - last < kLeastRows) last = stretch.last;
      if (last - first < kLeastRows) break;
      replay.run(plant, replay.fit(plant, first, last), first, last, predicted, motion);
      std::copy(predicted.begin(), predicted.end(), out.begin() + static_cast<std::ptrdiff_t>(first));
      first = last;
    }
  }
  return out;
}

std::vector<double> replay_open_loop(const Model& model, const Recording& recording,
                                     const ReplayOptions& options) {
  std::vector<double> out(recording.size(), kNaN), predicted;
  if (recording.size() == 0) return out;
  Replay replay(model, recording, options);
  for (const Segment& stretch : segments(recording.t_s)) {
    if (stretch.size() <= options.open_loop_rows) continue;
    Plant plant = replay.cold_plant(model, stretch.first);
    const Start start = replay.fit(plant, stretch.first, stretch.first + options.open_loop_rows);
    replay.run(plant, start, stretch.first, stretch.last, predicted);
    std::copy(predicted.begin(), predicted.end(), out.begin() + static_cast<std::ptrdiff_t>(stretch.first));
  }
  return out;
}

void SquaredError::add(double predicted_m, double measured_m) {
  const double e = predicted_m - measured_m;
  if (std::isnan(e)) return;
  sum_m2 += e * e;
  ++rows;
}

void SquaredError::add(const SquaredError& other) {
  sum_m2 += other.sum_m2;
  rows += other.rows;
}

double SquaredError::rms_m() const {
  return rows == 0 ? kNaN : std::sqrt(sum_m2 / static_cast<double>(rows));
}

SquaredError squared_error(std::span<const double> predicted_m, std::span<const double> measured_m) {
  SquaredError error;
  for (std::size_t row = 0; row < predicted_m.size(); ++row) error.add(predicted_m[row], measured_m[row]);
  return error;
}

SquaredError open_loop_error(std::span<const double> predicted_m, const Recording& recording,
                             const ReplayOptions& options) {
  SquaredError error;
  for (const Segment& stretch : segments(recording.t_s)) {
    for (std::size_t row = stretch.first + options.open_loop_rows; row < stretch.last; ++row) {
      error.add(predicted_m[row], recording.y_m[row]);
    }
  }
  return error;
}

}  // namespace cartwright
