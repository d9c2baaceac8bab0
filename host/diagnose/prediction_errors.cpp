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

double closed_loop_rmse_m(const Model& model, const Session& session, unsigned threads) {
  return rms_m(session, threads, [&](const Recording& r) {
    return r.has_controller() ? squared_error(simulate(model, session.rig, r).y_m, r.y_m) : SquaredError{};
  });
}

}  // namespace cartwright
