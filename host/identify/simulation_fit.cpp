#include "host/identify/simulation_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "host/identify/simulation_search.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kLeastRows = 100;
constexpr std::size_t kLeastRecordings = 4;
/// Directions of the unit-diagonal J'' flatter than this are not told by the data.
constexpr double kFlat = 1e-9;

Recording part_of(const Recording& whole, std::size_t first, std::size_t last) {
  Recording out;
  out.file = whole.file;
  const auto cut = [&](const std::vector<double>& column) {
    return std::vector<double>(column.begin() + static_cast<std::ptrdiff_t>(first),
                               column.begin() + static_cast<std::ptrdiff_t>(last));
  };
  out.t_s = cut(whole.t_s);
  out.y_m = cut(whole.y_m);
  out.u_V = cut(whole.u_V);
  return out;
}

std::vector<SimulatedPiece> pieces_of(const std::vector<Recording>& recordings,
                                      const std::vector<double>& started_s) {
  std::vector<SimulatedPiece> out;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    if (recordings[i].size() < kLeastRows) continue;
    ReplayOptions replay;
    replay.started_s = started_s[i];
    replay.range = motion_range_of({&recordings[i], 1});
    out.push_back({&recordings[i], replay});
  }
  return out;
}

double rms(const std::vector<VectorXd>& errors, std::size_t* rows = nullptr) {
  double sum = 0;
  Eigen::Index count = 0;
  for (const VectorXd& e : errors) {
    sum += e.squaredNorm();
    count += e.size();
  }
  if (rows != nullptr) *rows = static_cast<std::size_t>(count);
  return std::sqrt(sum / static_cast<double>(count));
}

/// Which numbers take part in a direction in which J is flat, or have no effect at all.
std::vector<bool> flat_numbers(const MatrixXd& curvature) {
  const Eigen::Index n = curvature.rows();
  std::vector<bool> out(static_cast<std::size_t>(n), false);
  VectorXd unit(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const bool dead = !(curvature(j, j) > 0);
    out[static_cast<std::size_t>(j)] = dead;
    unit(j) = dead ? 0 : 1 / std::sqrt(curvature(j, j));
  }
  MatrixXd normed = unit.asDiagonal() * curvature * unit.asDiagonal();
  for (Eigen::Index j = 0; j < n; ++j)
    if (unit(j) == 0) normed(j, j) = 1;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(normed);
  for (Eigen::Index k = 0; k < n && solver.eigenvalues()(k) < kFlat; ++k) {
    for (Eigen::Index j = 0; j < n; ++j)
      if (std::abs(solver.eigenvectors()(j, k)) > 0.3) out[static_cast<std::size_t>(j)] = true;
  }
  return out;
}

/// Variances of the delete-one jackknife over pieces, each left out by one Newton step from the whole fit.
VectorXd jackknife_variance(const SimulationSearch& search) {
  const std::size_t count = search.curvature.size();
  const MatrixXd all = search.total_curvature();
  const VectorXd slope = search.total_slope();
  MatrixXd moved(all.rows(), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    moved.col(static_cast<Eigen::Index>(i)) =
        (all - search.curvature[i]).completeOrthogonalDecomposition().solve(slope - search.slope[i]);
  const VectorXd mean = moved.rowwise().mean();
  const double share = static_cast<double>(count - 1) / static_cast<double>(count);
  return share * (moved.colwise() - mean).rowwise().squaredNorm();
}

std::vector<ParameterEstimate> estimates_of(const Model& model, const std::vector<SlowParameter>& free,
                                            const SimulationSearch& search,
                                            std::vector<Parameter>& not_separable) {
  const std::vector<bool> flat = flat_numbers(search.total_curvature());
  const std::size_t recordings = search.curvature.size();
  VectorXd variance;
  if (recordings >= kLeastRecordings) variance = jackknife_variance(search);
  std::vector<ParameterEstimate> out;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const ParameterInfo& limits = info(free[j].id);
    ParameterEstimate one{free[j].id, {.value = model[free[j].id]}};
    one.at_bound = model[free[j].id] <= limits.lower || model[free[j].id] >= limits.upper;
    if (flat[j]) {
      not_separable.push_back(free[j].id);
    } else if (variance.size() > 0 && !one.at_bound) {
      const double t = student_t(0.95, static_cast<double>(recordings - 1));
      one.estimate = Estimate::within(one.estimate.value,
                                      t * free[j].scale * std::sqrt(variance(static_cast<Eigen::Index>(j))));
    }
    out.push_back(one);
  }
  return out;
}

}  // namespace

Result<SimulationFit> fit_by_simulation(const Session& session, const Model& start,
                                        const SimulationFitOptions& options) {
  const std::vector<SlowParameter> free = slow_parameters(session, start, options.held);
  std::vector<double> started_s;
  for (const Recording& r : session.recordings) started_s.push_back(r.t_s.empty() ? 0 : r.t_s.front());
  const std::vector<SimulatedPiece> whole = pieces_of(session.recordings, started_s);
  if (whole.empty()) return failure(fmt::format("no recording has {} rows to simulate", kLeastRows));
  if (free.empty()) return failure("nothing to fit: every number of the model is held");

  SimulationSearch search(whole, free, options.threads);
  SimulationFit out;
  out.before_m = rms(search.errors(start), &out.rows);
  if (out.rows == 0) return failure("gaps leave no stretch long enough to simulate");
  if (!std::isfinite(out.before_m))
    return failure("the given model runs away when it is simulated; start from one that identify found");

  // One fit to whole recordings, one to their first halves.
  const double most_ticks = 2.0 * SimulationSearch::most_iterations();
  double ticks = 0;
  const auto tick = [&] {
    if (options.progress) options.progress(std::min(1.0, ++ticks / most_ticks));
  };
  out.model = search.run(start, tick);
  if (!(search.total_curvature().trace() > 0)) return failure("nothing moves in these recordings");
  out.after_m = rms(search.errors(out.model));
  out.estimates = estimates_of(out.model, free, search, out.not_separable);
  for (const ParameterInfo& parameter : parameters()) {
    if (parameter.term && !start.has(*parameter.term)) continue;
    if (parameter.default_value && start[parameter.id] == *parameter.default_value) continue;
    if (std::none_of(free.begin(), free.end(), [&](const auto& one) { return one.id == parameter.id; }))
      out.held.push_back(parameter.id);
  }

  std::vector<Recording> first, second;
  for (const Recording& r : session.recordings) {
    first.push_back(part_of(r, 0, r.size() / 2));
    second.push_back(part_of(r, r.size() / 2, r.size()));
  }
  const std::vector<SimulatedPiece> seen = pieces_of(first, started_s), unseen = pieces_of(second, started_s);
  if (!seen.empty() && !unseen.empty()) {
    const Model half = SimulationSearch(seen, free, options.threads).run(start, tick);
    out.held_out_m = rms(SimulationSearch(unseen, free, options.threads).errors(half));
  }
  return out;
}

}  // namespace cartwright
