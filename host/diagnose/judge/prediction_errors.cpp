#include "host/diagnose/judge/prediction_errors.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/replay.hpp"
#include "host/parallel.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

constexpr double kBeyondChance = 0.95;  // both sides

}  // namespace

std::vector<SquaredError> window_errors(const Model& model, const Session& session, unsigned threads) {
  std::vector<std::vector<SquaredError>> errors(session.recordings.size());
  ReplayOptions options;
  options.linear_by_steps = true;
  parallel_for(errors.size(), threads, [&](std::size_t n) {
    const Recording& r = session.recordings[n];
    const std::vector<double> predicted_m = replay_windows(model, r, options);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const auto window = static_cast<std::size_t>((r.t_s[k] - r.t_s.front()) / options.window_s);
      if (window >= errors[n].size()) errors[n].resize(window + 1);
      errors[n][window].add(predicted_m[k], r.y_m[k]);
    }
  });
  std::vector<SquaredError> all;
  for (const std::vector<SquaredError>& of_recording : errors)
    all.insert(all.end(), of_recording.begin(), of_recording.end());
  return all;
}

double rms_m(const std::vector<SquaredError>& errors) {
  SquaredError sum;
  for (const SquaredError& error : errors) sum.add(error);
  return sum.rms_m();
}

double window_rmse_m(const Model& model, const Session& session, unsigned threads) {
  return rms_m(window_errors(model, session, threads));
}

bool worse_beyond_chance(const std::vector<SquaredError>& by, const std::vector<SquaredError>& than_by) {
  const std::size_t n = by.size();
  if (n < 3) return false;
  Eigen::ArrayXd more(n);  // mean squares of each window
  for (std::size_t i = 0; i < n; ++i) {
    more[static_cast<Eigen::Index>(i)] =
        (by[i].sum_m2 - than_by[i].sum_m2) / static_cast<double>(std::max<std::size_t>(1, by[i].rows));
  }
  const double degrees = static_cast<double>(n - 1);
  const double spread = std::sqrt((more - more.mean()).square().sum() / degrees / static_cast<double>(n));
  return more.mean() > student_t(kBeyondChance, degrees) * spread;
}

std::vector<SquaredError> closed_loop_errors(const Model& model, const Session& session, unsigned threads) {
  std::vector<SquaredError> errors(session.recordings.size());
  parallel_for(errors.size(), threads, [&](std::size_t n) {
    const Recording& r = session.recordings[n];
    if (r.has_controller()) errors[n] = squared_error(simulate(model, session.rig, r).y_m, r.y_m);
  });
  return errors;
}

}  // namespace cartwright
