#include "host/identify/damping_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cartwright {
namespace {

/// The straight line through the logarithms for one gamma, and F(gamma).
struct Trial {
  DampingLaw law;
  double cost = std::numeric_limits<double>::infinity();
};

Trial trial(std::span<const double> v, std::span<const double> c, double gamma) {
  double n = 0, s = 0, ss = 0, l = 0, sl = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double logarithm = std::log(c[i] - gamma);
    n += 1;
    s += v[i];
    ss += v[i] * v[i];
    l += logarithm;
    sl += v[i] * logarithm;
  }
  Trial out;
  const double slope = (n * sl - s * l) / (n * ss - s * s);
  out.law = {std::exp((l - slope * s) / n), -slope, gamma};
  if (!(slope < 0) || !std::isfinite(slope)) return out;
  out.cost = 0;
  for (std::size_t i = 0; i < v.size(); ++i) out.cost += std::pow(out.law.at(v[i]) - c[i], 2);
  return out;
}

}  // namespace

double DampingLaw::at(double speed_m_per_s) const {
  return alpha1_per_s * std::exp(-alpha2_s_per_m * speed_m_per_s) + gamma_per_s;
}

Result<DampingLaw> fit_damping_law(std::span<const double> speed_m_per_s,
                                   std::span<const double> damping_per_s) {
  if (speed_m_per_s.size() < 3)
    return failure("the exponential damping law needs at least three damping values");
  const double least = *std::min_element(damping_per_s.begin(), damping_per_s.end());
  if (!(least > 0))
    return failure("a damping value is not positive; constrain the damping (--monotone, --slope)");
  // gamma = least (1 - exp(-x)): a grid over x that is fine near the least value, then golden section.
  const auto at = [&](double x) { return trial(speed_m_per_s, damping_per_s, -least * std::expm1(-x)); };
  constexpr int kGrid = 60;
  constexpr double kMost = 14;
  Trial best;
  double best_x = 0;
  for (int i = 0; i <= kGrid; ++i) {
    const double x = kMost * i / kGrid;
    const Trial candidate = at(x);
    if (candidate.cost < best.cost) {
      best = candidate;
      best_x = x;
    }
  }
  if (!std::isfinite(best.cost))
    return failure("the damping does not fall with speed: no exponential law fits it");
  double low = std::max(0.0, best_x - kMost / kGrid), high = best_x + kMost / kGrid;
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 50; ++i) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (at(a).cost < at(b).cost) {
      high = b;
    } else {
      low = a;
    }
  }
  const Trial refined = at(0.5 * (low + high));
  return refined.cost < best.cost ? refined.law : best.law;
}

}  // namespace cartwright
