#include "host/identify/simulation_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/parallel.hpp"
#include "host/session/segments.hpp"

namespace cartwright {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Central differences reach this far, in units of a number's natural size: round by round finer.
constexpr double kReaches[] = {3e-3, 5e-4};
constexpr int kMostIterations = 30;  ///< in a round
constexpr int kMostAttempts = 8;     ///< at a step, each with ten times the damping
constexpr double kLeastFall = 1e-5;  ///< of the cost, relative: where a round ends
constexpr double kTinyDamping = 1e-9;

VectorXd errors_of(const Model& model, const SimulatedPiece& piece) {
  const Recording& r = *piece.recording;
  const std::vector<double> predicted_m = replay_open_loop(model, r, piece.replay);
  std::vector<double> errors;
  errors.reserve(r.size());
  for (const Segment& stretch : segments(r.t_s)) {
    for (std::size_t k = stretch.first + piece.replay.open_loop_rows; k < stretch.last; ++k)
      errors.push_back(r.y_m[k] - predicted_m[k]);
  }
  return Eigen::Map<const VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

/// Infinite where a simulation runs away.
double cost(const std::vector<VectorXd>& errors) {
  double sum = 0;
  for (const VectorXd& e : errors) sum += e.squaredNorm();
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

template <typename Matrix>
Matrix total(const std::vector<Matrix>& parts) {
  Matrix sum = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i];
  return sum;
}

}  // namespace

int SimulationSearch::most_iterations() {
  return kMostIterations * static_cast<int>(std::size(kReaches));
}

MatrixXd SimulationSearch::total_curvature() const {
  return total(curvature);
}
VectorXd SimulationSearch::total_slope() const {
  return total(slope);
}

std::vector<VectorXd> SimulationSearch::errors(const Model& model) const {
  std::vector<VectorXd> out(pieces_.size());
  parallel_for(pieces_.size(), threads_, [&](std::size_t i) { out[i] = errors_of(model, pieces_[i]); });
  return out;
}

void SimulationSearch::linearise(const Model& model, const std::vector<VectorXd>& at, double reach) {
  const std::size_t n = free_.size(), pieces = pieces_.size();
  std::vector<Model> low(n, model), high(n, model);
  std::vector<double> apart(n);
  for (std::size_t j = 0; j < n; ++j) {
    const Parameter id = free_[j].id;
    const double here = model[id], away = reach * free_[j].scale;
    low[j].set(id, std::max(here - away, info(id).lower));
    high[j].set(id, std::min(here + away, info(id).upper));
    apart[j] = (high[j][id] - low[j][id]) / free_[j].scale;
  }
  std::vector<VectorXd> below(n * pieces), above(n * pieces);
  parallel_for(2 * n * pieces, threads_, [&](std::size_t task) {
    const std::size_t which = task / 2, j = which % n, i = which / n;
    if (task % 2 == 0) {
      below[which] = errors_of(low[j], pieces_[i]);
    } else {
      above[which] = errors_of(high[j], pieces_[i]);
    }
  });
  curvature.resize(pieces);
  slope.resize(pieces);
  for (std::size_t i = 0; i < pieces; ++i) {
    MatrixXd jacobian(at[i].size(), static_cast<Eigen::Index>(n));
    for (std::size_t j = 0; j < n; ++j)
      jacobian.col(static_cast<Eigen::Index>(j)) = (below[i * n + j] - above[i * n + j]) / apart[j];
    curvature[i] = jacobian.transpose() * jacobian;
    slope[i] = jacobian.transpose() * at[i];
  }
}

/// The damped step; numbers at a bound that want to cross it stay there.
VectorXd SimulationSearch::step(const Model& model, double damping) const {
  const auto n = static_cast<Eigen::Index>(free_.size());
  MatrixXd a = total_curvature();
  const VectorXd g = total_slope();
  a.diagonal() *= 1 + damping;
  a.diagonal().array() += 1e-12 * a.trace();
  std::vector<Eigen::Index> open(free_.size());
  std::iota(open.begin(), open.end(), Eigen::Index{0});
  VectorXd d = VectorXd::Zero(n);
  while (!open.empty()) {
    const MatrixXd among = a(open, open);
    const VectorXd rise = g(open);
    d.setZero();
    d(open) = among.ldlt().solve(rise).eval();
    const auto crosses = [&](Eigen::Index j) {
      const Parameter id = free_[static_cast<std::size_t>(j)].id;
      return (model[id] <= info(id).lower && d(j) < 0) || (model[id] >= info(id).upper && d(j) > 0);
    };
    if (std::erase_if(open, crosses) == 0) return d;
  }
  return VectorXd::Zero(n);
}

Model SimulationSearch::moved(const Model& model, const VectorXd& by) const {
  Model out = model;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const auto& [id, scale] = free_[j];
    const double to = model[id] + by(static_cast<Eigen::Index>(j)) * scale;
    out.set(id, std::clamp(to, info(id).lower, info(id).upper));
  }
  return out;
}

Model SimulationSearch::run(const Model& start, const std::function<void()>& tick) {
  Model model = start;
  std::vector<VectorXd> now = errors(model);
  double best = cost(now);
  for (const double reach : kReaches) {
    double damping = 1e-3;
    for (int iteration = 0; iteration < kMostIterations; ++iteration) {
      linearise(model, now, reach);
      double fall = 0;
      for (int attempt = 0; attempt < kMostAttempts && fall == 0; ++attempt, damping *= 10) {
        const Model trial = moved(model, step(model, damping));
        std::vector<VectorXd> then = errors(trial);
        const double reached = cost(then);
        if (!(reached < best)) continue;
        fall = (best - reached) / best;
        best = reached;
        model = trial;
        now = std::move(then);
      }
      damping = std::max(damping * 1e-2, kTinyDamping);
      tick();
      if (fall < kLeastFall) break;
    }
  }
  linearise(model, now, *std::rbegin(kReaches));
  return model;
}

}  // namespace cartwright
