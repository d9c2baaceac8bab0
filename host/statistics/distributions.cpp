#include "host/statistics/distributions.hpp"

#include <cmath>
#include <numbers>

namespace cartwright {

double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) /
      a;
  constexpr double kTiny = 1e-300;
  double c = 1, d = 0, fraction = 1;
  for (int i = 0; i < 10000; ++i) {
    const double m = i / 2;  // NOLINT(bugprone-integer-division): the coefficients come in pairs
    double numerator = 1;
    if (i > 0) {
      numerator = i % 2 == 0 ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                             : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    }
    d = 1 + numerator * d;
    d = 1 / (std::abs(d) < kTiny ? kTiny : d);
    c = 1 + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    const double change = c * d;
    fraction *= change;
    if (i > 0 && std::abs(change - 1) < 1e-15) break;
  }
  return front * (fraction - 1);
}

double inverse_incomplete_beta(double a, double b, double p) {
  const double logarithm = std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b);
  double low = 0, high = 1, x = a / (a + b);
  for (int i = 0; i < 200; ++i) {
    const double away = incomplete_beta(a, b, x) - p;
    (away < 0 ? low : high) = x;
    const double density = std::exp(logarithm + (a - 1) * std::log(x) + (b - 1) * std::log1p(-x));
    const double newton = x - away / density;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool settled = std::abs(next - x) <= 1e-15 * x;
    x = next;
    if (settled || high - low <= 1e-16 * x) break;
  }
  return x;
}

double student_t(double probability, double degrees) {
  if (degrees > 60) {
    // Expansion about the normal quantile (Abramowitz and Stegun 26.7.5): relative error below 1e-8 from here
    // on.
    const double z = normal(probability), z2 = z * z, d = degrees;
    const double g1 = z * (z2 + 1) / 4;
    const double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
    const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
    const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
    return z + (g1 + (g2 + (g3 + g4 / d) / d) / d) / d;
  }
  // P(|t| < q) = I_x(1/2, degrees/2) with x = q^2/(degrees + q^2).
  const double x = inverse_incomplete_beta(0.5, 0.5 * degrees, probability);
  return std::sqrt(degrees * x / (1 - x));
}

double normal(double probability) {
  // Newton's method on erfc, which falls convexly: started below the root it never passes it.
  const double outside = 1 - probability;
  double z = 0;
  for (int i = 0; i < 60; ++i) {
    const double slope = -2 / std::sqrt(2 * std::numbers::pi) * std::exp(-0.5 * z * z);
    const double step = (std::erfc(z / std::numbers::sqrt2) - outside) / slope;
    z -= step;
    if (std::abs(step) < 1e-14 * (1 + z)) break;
  }
  return z;
}

double f_quantile(double probability, double numerator, double denominator) {
  const double x = inverse_incomplete_beta(0.5 * numerator, 0.5 * denominator, probability);
  return denominator * x / (numerator * (1 - x));
}

}  // namespace cartwright
