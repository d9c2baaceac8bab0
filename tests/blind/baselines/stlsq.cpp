#include "tests/blind/baselines/stlsq.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright::blind {
namespace {

constexpr double kRidge = 1e-5;  // of a column's own square
constexpr std::size_t kFolds = 5;
constexpr double kThresholds[] = {0.003, 0.006, 0.01, 0.02, 0.03, 0.05, 0.08, 0.13, 0.2, 0.35};

/// Least squares on the columns chosen; zero elsewhere.
Eigen::VectorXd solve(const NormalEquations& problem, const std::vector<Eigen::Index>& chosen) {
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index c = chosen[static_cast<std::size_t>(i)];
    scale[i] = problem.gram(c, c) > 0 ? 1 / std::sqrt(problem.gram(c, c)) : 0;
  }
  Eigen::MatrixXd h = scale.asDiagonal() * problem.gram(chosen, chosen) * scale.asDiagonal();
  h.diagonal().array() += kRidge;
  const Eigen::VectorXd g = scale.asDiagonal() * problem.moment(chosen);
  const Eigen::VectorXd solution = scale.asDiagonal() * h.ldlt().solve(g);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(problem.moment.size());
  for (Eigen::Index i = 0; i < n; ++i) all[chosen[static_cast<std::size_t>(i)]] = solution[i];
  return all;
}

}  // namespace

void NormalEquations::add_row(const Eigen::VectorXd& row, double right) {
  gram.selfadjointView<Eigen::Lower>().rankUpdate(row);
  moment += right * row;
  square += right * right;
  rows += 1;
}

void NormalEquations::mirror() {
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  gram += other.gram;
  moment += other.moment;
  square += other.square;
  rows += other.rows;
  return *this;
}

double NormalEquations::left(const Eigen::VectorXd& coefficients) const {
  return square - 2 * moment.dot(coefficients) + coefficients.dot(gram * coefficients);
}

Eigen::VectorXd stlsq(const NormalEquations& problem, double threshold, Eigen::Index kept) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index c = 0; c < problem.moment.size(); ++c) chosen.push_back(c);
  for (;;) {
    const Eigen::VectorXd coefficients = solve(problem, chosen);
    const std::size_t dropped = std::erase_if(chosen, [&](Eigen::Index c) {
      const double contribution = std::abs(coefficients[c]) * std::sqrt(problem.gram(c, c) / problem.square);
      return c >= kept && contribution < threshold;
    });
    if (dropped == 0) return coefficients;
  }
}

Eigen::VectorXd stlsq_cross_validated(const std::vector<NormalEquations>& parts, Eigen::Index kept) {
  NormalEquations all(parts.front().moment.size());
  for (const NormalEquations& part : parts) all += part;
  double best_mean = 0, best_spread = 0, chosen = kThresholds[0];
  std::vector<double> means;
  for (const double threshold : kThresholds) {
    std::vector<double> errors;
    for (std::size_t fold = 0; fold < std::min(kFolds, parts.size()); ++fold) {
      NormalEquations fitted(all.moment.size()), judged(all.moment.size());
      for (std::size_t n = 0; n < parts.size(); ++n) (n % kFolds == fold ? judged : fitted) += parts[n];
      if (judged.rows == 0 || fitted.rows == 0) continue;
      errors.push_back(judged.left(stlsq(fitted, threshold, kept)) / judged.rows);
    }
    double mean = 0, squares = 0;
    for (const double e : errors) mean += e, squares += e * e;
    const double n = static_cast<double>(errors.size());
    mean /= n;
    means.push_back(mean);
    if (means.size() == 1 || mean < best_mean) {
      best_mean = mean;
      best_spread = std::sqrt(std::max(squares / n - mean * mean, 0.0) / std::max(n - 1, 1.0));
    }
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (means[i] <= best_mean + best_spread) chosen = kThresholds[i];
  }
  return stlsq(all, chosen, kept);
}

}  // namespace cartwright::blind
