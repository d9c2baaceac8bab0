#include "host/diagnose/search/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "host/parallel.hpp"

namespace cartwright {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Weights and rates for n numbers, equations (49) to (58) of the tutorial without negative weights.
struct Rates {
  explicit Rates(double n) : population(4 + static_cast<int>(3 * std::log(n))), weights(population / 2) {
    for (Eigen::Index i = 0; i < weights.size(); ++i)
      weights[i] = std::log(0.5 * (population + 1)) - std::log(static_cast<double>(i) + 1);
    weights /= weights.sum();
    selected = 1 / weights.squaredNorm();
    of_path = (4 + selected / n) / (n + 4 + 2 * selected / n);
    of_step_path = (selected + 2) / (n + selected + 5);
    of_rank_one = 2 / ((n + 1.3) * (n + 1.3) + selected);
    of_rank_many =
        std::min(1 - of_rank_one, 2 * (selected - 2 + 1 / selected) / ((n + 2) * (n + 2) + selected));
    step_damping = 1 + 2 * std::max(0.0, std::sqrt((selected - 1) / (n + 1)) - 1) + of_step_path;
    expected_length = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  }

  int population;
  VectorXd weights;  // of the better half, best first
  double selected, of_path, of_step_path, of_rank_one, of_rank_many, step_damping, expected_length;
};

}  // namespace

VectorXd evolve(const std::function<double(const VectorXd&)>& cost, const VectorXd& start,
                const EvolutionOptions& options) {
  const Eigen::Index n = start.size();
  const Rates rates(static_cast<double>(n));
  const auto population = static_cast<std::size_t>(rates.population);
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  VectorXd mean = start, best = start, path = VectorXd::Zero(n), step_path = VectorXd::Zero(n);
  MatrixXd covariance = MatrixXd::Identity(n, n);
  double step = 1, least = cost(start);
  std::vector<VectorXd> moves(population, VectorXd(n));
  std::vector<double> costs(population);
  std::vector<std::size_t> order(population);
  for (int asked = 1, generation = 1; asked + rates.population <= options.most_evaluations; ++generation) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(covariance);
    const VectorXd lengths = axes.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
    for (VectorXd& move : moves) {
      VectorXd z(n);
      for (double& each : z) each = normal(random);
      move = axes.eigenvectors() * lengths.cwiseProduct(z);
    }
    parallel_for(population, options.threads,
                 [&](std::size_t i) { costs[i] = cost(mean + step * moves[i]); });
    asked += rates.population;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
    if (costs[order.front()] < least) {
      least = costs[order.front()];
      best = mean + step * moves[order.front()];
    }

    VectorXd move = VectorXd::Zero(n);
    MatrixXd spread = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < rates.weights.size(); ++i) {
      const VectorXd& one = moves[order[static_cast<std::size_t>(i)]];
      move += rates.weights[i] * one;
      spread += rates.weights[i] * one * one.transpose();
    }
    mean += step * move;
    const VectorXd whitened =
        axes.eigenvectors() * (axes.eigenvectors().transpose() * move).cwiseQuotient(lengths);
    step_path = (1 - rates.of_step_path) * step_path +
                std::sqrt(rates.of_step_path * (2 - rates.of_step_path) * rates.selected) * whitened;
    const double length = step_path.norm() / rates.expected_length;
    const double started = std::sqrt(1 - std::pow(1 - rates.of_step_path, 2 * generation));
    const bool steady = length / started < 1.4 + 2 / (static_cast<double>(n) + 1);
    path *= 1 - rates.of_path;
    if (steady) path += std::sqrt(rates.of_path * (2 - rates.of_path) * rates.selected) * move;
    const double kept = 1 - rates.of_rank_one - rates.of_rank_many +
                        (steady ? 0 : rates.of_rank_one * rates.of_path * (2 - rates.of_path));
    covariance =
        kept * covariance + rates.of_rank_one * path * path.transpose() + rates.of_rank_many * spread;
    step *= std::exp(rates.of_step_path / rates.step_damping * (length - 1));
  }
  return best;
}

}  // namespace cartwright
