#include "host/diagnose/window_errors.hpp"

#include "host/evaluate/replay.hpp"
#include "host/parallel.hpp"

namespace cartwright {

double window_rmse_m(const Model& model, const Session& session, unsigned threads) {
  std::vector<SquaredError> errors(session.recordings.size());
  parallel_for(errors.size(), threads, [&](std::size_t n) {
    const Recording& recording = session.recordings[n];
    errors[n] = squared_error(replay_windows(model, recording), recording.y_m);
  });
  SquaredError sum;
  for (const SquaredError& error : errors) sum.add(error);
  return sum.rms_m();
}

}  // namespace cartwright
