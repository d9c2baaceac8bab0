#include "host/diagnose/judge/whole_recordings.hpp"

#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/identify/simulation_fit.hpp"

namespace cartwright {

std::optional<Model> fitted_to_whole_recordings(const Model& model, const Session& session,
                                                const std::vector<Parameter>& held, unsigned threads) {
  const auto whole = fit_by_simulation(session, model, {.held = held, .threads = threads, .progress = {}});
  if (!whole) return std::nullopt;
  const double windows =
      window_rmse_m(whole->model, session, threads) / window_rmse_m(model, session, threads);
  if (!(windows * whole->after_m < whole->before_m)) return std::nullopt;
  return whole->model;
}

}  // namespace cartwright
