#include "host/identify/resample.hpp"

#include <algorithm>
#include <cmath>

#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t next(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Eigen::MatrixXd resample(const std::vector<ResampleUnit>& units, int draws, std::uint64_t seed) {
  const Eigen::Index size = units.front().gradient.size();
  Eigen::MatrixXd out(draws, size);
  Eigen::MatrixXd information(size, size);
  Eigen::VectorXd gradient(size);
  for (int draw = 0; draw < draws; ++draw) {
    information.setZero();
    gradient.setZero();
    for (std::size_t i = 0; i < units.size(); ++i) {
      const ResampleUnit& unit = units[next(seed) % units.size()];
      information += unit.information;
      gradient += unit.gradient;
    }
    out.row(draw) = information.completeOrthogonalDecomposition().solve(gradient).transpose();
  }
  return out;
}

std::vector<Eigen::VectorXd> random_signs(const std::vector<Eigen::VectorXd>& gradients, int draws,
                                          std::uint64_t seed) {
  std::vector<Eigen::VectorXd> out;
  for (int draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(gradients.front().size());
    for (const Eigen::VectorXd& gradient : gradients) sum += (next(seed) & 1) != 0 ? gradient : -gradient;
    out.push_back(std::move(sum));
  }
  return out;
}

double half_width_95(std::vector<double> draws, std::size_t units) {
  std::sort(draws.begin(), draws.end());
  const auto quantile = [&](double share) {
    const double at = share * static_cast<double>(draws.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, draws.size() - 1);
    return draws[low] + (at - static_cast<double>(low)) * (draws[high] - draws[low]);
  };
  const double count = static_cast<double>(units);
  return 0.5 * (quantile(0.975) - quantile(0.025)) * student_t(0.95, count - 1) / normal(0.95) *
         std::sqrt(count / (count - 1));
}

}  // namespace cartwright
