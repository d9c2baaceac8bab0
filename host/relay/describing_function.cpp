#include "host/relay/describing_function.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace cartwright {
namespace {

constexpr double kQuarterPi = std::numbers::pi / 4;

/// Tp/Kp in least squares over h1 = (pi/4) a w^2 Tp/Kp.
double inertia(std::span<const RelayFeature> experiments) {
  double xx = 0, xy = 0;
  for (const RelayFeature& e : experiments) {
    const double x = kQuarterPi * e.amplitude_m * e.frequency_rad_per_s * e.frequency_rad_per_s;
    xx += x * x;
    xy += x * e.h1_V;
  }
  return xy / xx;
}

/// Least squares of h2 on rows built from each experiment; none where the rows do not tell the unknowns
/// apart.
template <typename Row>
std::optional<Eigen::VectorXd> fit_h2(std::span<const RelayFeature> experiments, Eigen::Index unknowns,
                                      Row row) {
  const auto rows = static_cast<Eigen::Index>(experiments.size());
  if (rows < unknowns) return std::nullopt;
  Eigen::MatrixXd a(rows, unknowns);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const RelayFeature& e = experiments[static_cast<std::size_t>(i)];
    a.row(i) = row(e);
    b(i) = e.h2_V;
  }
  const Eigen::VectorXd scale = a.colwise().norm();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a * scale.cwiseInverse().asDiagonal());
  qr.setThreshold(1e-6);
  if (qr.rank() < unknowns) return std::nullopt;
  return qr.solve(b).cwiseQuotient(scale).eval();
}

}  // namespace

Result<RelayCombinations> corrected_describing_function(std::span<const RelayFeature> experiments) {
  const auto h2 = fit_h2(experiments, 2, [](const RelayFeature& e) {
    return Eigen::RowVector2d(1, kQuarterPi * e.amplitude_m * e.frequency_rad_per_s);
  });
  if (!h2) return failure("the describing function needs two relay experiments with different speeds");
  return RelayCombinations{inertia(experiments), (*h2)(0), (*h2)(1)};
}

Result<RelayFourParameters> published_describing_function(std::span<const RelayFeature> experiments) {
  const auto h2 = fit_h2(experiments, 3, [](const RelayFeature& e) {
    const double x = kQuarterPi * e.amplitude_m;
    return Eigen::RowVector3d(1, x, x * e.frequency_rad_per_s);
  });
  if (!h2) return failure("the published equations need three different relay experiments");
  RelayFourParameters p;
  p.f1_V = (*h2)(0);
  p.f2 = (*h2)(1);
  p.kp = 1 / (*h2)(2);
  p.tp_s = inertia(experiments) * p.kp;
  return p;
}

Result<RelayFourParameters> published_equation_17(const RelayFeature& one, const RelayFeature& two) {
  const double a1 = one.amplitude_m, a2 = two.amplitude_m;
  const double w1 = one.frequency_rad_per_s, w2 = two.frequency_rad_per_s;
  if (std::abs(a2 - a1) < 1e-9 * a1)
    return failure("Eq. (17) needs two relay experiments with different amplitudes");
  RelayFourParameters p;
  p.tp_s = one.h1_V / (one.h2_V * w1);
  p.kp = kQuarterPi * a1 / std::hypot(one.h1_V, one.h2_V) * w1 * std::hypot(1.0, w1 * p.tp_s);
  p.f1_V = (-one.h1_V * a2 / (p.tp_s * w1) + two.h1_V * a1 / (p.tp_s * w2) + one.h2_V * a2 - two.h2_V * a1) /
           (a2 - a1);
  p.f2 = -(one.h1_V / (p.tp_s * w1) + p.f1_V - one.h2_V) / (kQuarterPi * a1);
  return p;
}

}  // namespace cartwright
