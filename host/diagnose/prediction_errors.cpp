#include "host/diagnose/prediction_errors.hpp"

#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/replay.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

template <typename ErrorOf>
double rms_m(const Session& session, unsigned threads, const ErrorOf& error_of) {
  std::vector<SquaredError> errors(session.recordings.size());
  parallel_for(errors.size(), threads, [&](std::size_t n) { errors[n] = error_of(session.recordings[n]); });
  SquaredError sum;
  for (const SquaredError& error : errors) sum.add(error);
  return sum.rms_m();
}

}  // namespace

double window_rmse_m(const Model& model, const Session& session, unsigned threads) {
  return rms_m(session, threads,
               [&](const Recording& r) { return squared_error(replay_windows(model, r), r.y_m); });
}

std::vector<double> window_mse_m2(const Model& model, const Session& session, unsigned threads) {
  std::vector<std::vector<SquaredError>> errors(session.recordings.size());
  parallel_for(errors.size(), threads, [&](std::size_t n) {
    const Recording& r = session.recordings[n];
    const std::vector<double> predicted_m = replay_windows(model, r);
    for (std::size_t k = 0; k < r.size(); ++k) {
      const auto window = static_cast<std::size_t>((r.t_s[k] - r.t_s.front()) / ReplayOptions().window_s);
      if (window >= errors[n].size()) errors[n].resize(window + 1);
      errors[n][window].add(predicted_m[k], r.y_m[k]);
    }
  });
  std::vector<double> out;
  for (const std::vector<SquaredError>& of_recording : errors) {
    for (const SquaredError& e : of_recording) {
      if (e.rows > 0) out.push_back(e.sum_m2 / static_cast<double>(e.rows));
    }
  }
  return out;
}

double closed_loop_rmse_m(const Model& model, const Session& session, unsigned threads) {
  return rms_m(session, threads, [&](const Recording& r) {
    return r.has_controller() ? squared_error(simulate(model, session.rig, r).y_m, r.y_m) : SquaredError{};
  });
}

}  // namespace cartwright
