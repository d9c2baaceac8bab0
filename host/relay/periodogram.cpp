#include "host/relay/periodogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/relay/angle.hpp"
#include "host/relay/fft.hpp"
#include "host/relay/vector_sums.hpp"
#include "host/vector_clones.hpp"

namespace cartwright {
namespace {

/// Below this many periods in the record the exact problem is solved at each frequency.
constexpr double kFewPeriods = 8;
/// Least number of periods looked for; fewer than one is refused later, but must be found to be refused.
constexpr double kLeastPeriods = 0.45;
/// A second peak this close to the highest is tried as well.
constexpr double kRivalPower = 0.7;

/// Sums over the samples at one angular frequency w, about the middle of the record.
struct Sums {
  double c, s, cc, ss, cs, xc, xs;  ///< of cos, sin, cos^2, sin^2, cos sin, x cos, x sin
};

/// Even sampling: Dirichlet kernel D(w) = sin(n w h/2)/sin(w h/2); sums odd in time vanish.
Sums even_sums(double n, double spacing, double half_span, double w) {
  const auto dirichlet = [&](double v) {
    const double half = 0.5 * v * spacing;
    return std::sin(n * half) / std::sin(half);
  };
  const double half = 0.5 * w * spacing;
  const double d1 = dirichlet(w), d2 = dirichlet(2 * w);
  // sum tau sin(w tau) = -dD/dw
  const double slope =
      (0.5 * n * spacing * std::cos(n * half) - 0.5 * spacing * std::cos(half) * d1) / std::sin(half);
  return {d1, 0, 0.5 * (n + d2), 0.5 * (n - d2), 0, 0, -slope / half_span};
}

Sums direct_sums(const SineProblem& problem, double w) {
  Sums sums{};
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const double c = std::cos(w * problem.tau_s()[i]), s = std::sin(w * problem.tau_s()[i]);
    const double x = problem.x()[i];
    sums.c += c;
    sums.s += s;
    sums.cc += c * c;
    sums.ss += s * s;
    sums.cs += c * s;
    sums.xc += x * c;
    sums.xs += x * s;
  }
  return sums;
}

struct Line {
  double mean_x, xx;  ///< mean of x, sum of (x - mean)^2
};

/// Drop of the sum of squares through cos and sin, once offset (and x, where `trend`) are taken out of
/// everything. `yc`, `ys` are products with y that already has them taken out.
double drop(const Sums& k, double n, const Line& line, bool trend, double yc, double ys) {
  double cc = k.cc - k.c * k.c / n, ss = k.ss - k.s * k.s / n, cs = k.cs - k.c * k.s / n;
  if (trend) {
    const double xc = k.xc - line.mean_x * k.c, xs = k.xs - line.mean_x * k.s;
    cc -= xc * xc / line.xx;
    ss -= xs * xs / line.xx;
    cs -= xc * xs / line.xx;
  }
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 1e-9 * n * n)) return 0;
  return (ss * yc * yc - 2 * cs * yc * ys + cc * ys * ys) / determinant;
}

/// Highest peak, refined by a parabola, and any rival to it.
std::vector<double> peaks(const std::vector<float>& power, double spacing_hz) {
  const float highest = greatest(power.data(), power.size());
  const float rival = static_cast<float>(kRivalPower) * highest;
  std::vector<std::size_t> maxima;
  constexpr std::size_t kStretch = 32;  // looked into only where it holds something high enough
  for (std::size_t begin = 0; begin < power.size(); begin += kStretch) {
    const std::size_t end = std::min(begin + kStretch, power.size());
    if (!(highest > 0) || greatest(power.data() + begin, end - begin) < rival) continue;
    for (std::size_t k = std::max<std::size_t>(begin, 1); k < end; ++k) {
      const float next = k + 1 < power.size() ? power[k + 1] : 0.0F;
      if (power[k] >= rival && power[k] >= power[k - 1] && !(power[k] <= next)) maxima.push_back(k);
    }
  }
  constexpr std::size_t kMost = 3;
  const std::size_t most = std::min(kMost, maxima.size());
  std::partial_sort(maxima.begin(), maxima.begin() + static_cast<std::ptrdiff_t>(most), maxima.end(),
                    [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  std::vector<double> found;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t k = maxima[i];
    double shift = 0;
    if (k + 1 < power.size() && power[k - 1] > 0 && power[k + 1] > 0) {
      const double before = static_cast<double>(power[k - 1]), at = static_cast<double>(power[k]);
      const double after = static_cast<double>(power[k + 1]);
      shift = 0.5 * (before - after) / (before - 2 * at + after);
    }
    found.push_back((static_cast<double>(k) + shift) * spacing_hz);
  }
  return found;
}

}  // namespace

namespace {

/// Whether a time is more than a quarter of the spacing off its place. No branch, and a count that grows by
/// itself instead of being made from an index: it vectorises.
CARTWRIGHT_VECTOR_CLONES bool displaced(const std::vector<double>& tau_s, double half_span_s,
                                        double spacing_s) {
  const double per_spacing = 1 / spacing_s, first = half_span_s * per_spacing;
  const auto* tau = reinterpret_cast<const LanesAt*>(tau_s.data());
  Lanes place = {0, 1, 2, 3}, farthest{};
  for (std::size_t n = 0; n < tau_s.size() / kLanes; ++n) {
    const Lanes off = tau[n] * per_spacing + first - place, size = off < 0 ? -off : off;
    farthest = size > farthest ? size : farthest;
    place += static_cast<double>(kLanes);
  }
  double most = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) most = std::max(most, farthest[lane]);
  for (std::size_t i = tau_s.size() / kLanes * kLanes; i < tau_s.size(); ++i)
    most = std::max(most, std::abs(tau_s[i] * per_spacing + first - static_cast<double>(i)));
  return !(most < 0.25);
}

}  // namespace

EvenGrid::EvenGrid(const SineProblem& problem) {
  const std::size_t count = problem.size();
  const double half_span = problem.half_span_s();
  spacing_s = 2 * half_span / static_cast<double>(count - 1);
  even = !displaced(problem.tau_s(), half_span, spacing_s);
  size = count;
  if (even) return;
  std::vector<double> steps(count - 1);
  for (std::size_t i = 0; i + 1 < count; ++i) steps[i] = problem.tau_s()[i + 1] - problem.tau_s()[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  spacing_s = *middle;
  size = static_cast<std::size_t>(std::lround(2 * half_span / spacing_s)) + 1;
}

void EvenGrid::coarsen(const SineProblem& problem) {
  if (!too_sparse()) return;
  size = kGreatest;
  spacing_s = 2 * problem.half_span_s() / static_cast<double>(size - 1);
}

std::vector<float> EvenGrid::spread(const SineProblem& problem, std::span<const double> values) const {
  std::vector<float> out(size, 0.0F);
  if (even) {
    for (std::size_t i = 0; i < values.size(); ++i) out[i] = static_cast<float>(values[i]);
    return out;
  }
  const double per_spacing = 1 / spacing_s;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto at =
        static_cast<std::size_t>(std::lround((problem.tau_s()[i] + problem.half_span_s()) * per_spacing));
    out[std::min(at, size - 1)] += static_cast<float>(values[i]);
  }
  return out;
}

Result<SineSeeds> sine_seeds(const SineProblem& problem) {
  const std::size_t count = problem.size();
  const double n = static_cast<double>(count);
  const double half_span = problem.half_span_s();
  const EvenGrid times(problem);
  if (times.too_sparse()) {
    return failure(
        fmt::format("times are too uneven to look for a frequency: {} s of record, {} s between rows; "
                    "give the frequency, or a part without gaps",
                    2 * half_span, times.spacing_s));
  }
  const double spacing = times.spacing_s;
  const bool even = times.even;
  // y less its line, which would leak into every frequency.
  const double sx = sum(problem.x().data(), count), sxx = sum_of_squares(problem.x().data(), count);
  const double sxy = sum_of_products(problem.x().data(), problem.y().data(), count);
  const Line line{sx / n, sxx - sx * sx / n};
  const double slope = sxy / line.xx;
  // In units of its size, so that single precision holds it whatever the unit of y.
  const double inverse_unit = 1 / (std::sqrt(problem.cost_without_sine(true) / n) + 1e-300);
  std::vector<double> flat(count);
  for (std::size_t i = 0; i < count; ++i)
    flat[i] = (problem.y()[i] - slope * (problem.x()[i] - line.mean_x)) * inverse_unit;
  const std::vector<float> samples = times.spread(problem, flat);
  const std::size_t grid = times.size;
  std::size_t size = 64;
  while (size < 2 * grid) size *= 2;
  const Spectrum spectrum = real_spectrum(samples, size);

  const double bin_hz = 1 / (static_cast<double>(size) * spacing);
  const double record_s = 2 * half_span + spacing;
  const std::size_t bins = size / 2;
  const auto few = std::min(bins, static_cast<std::size_t>(kFewPeriods / (record_s * bin_hz)) + 1);
  std::vector<float> power_of(bins + 1, 0.0F), beside_trend(few, 0.0F);
  const double scale = 2 / n;
  for (std::size_t k = few; k < bins; ++k) {
    const float re = spectrum.real[k], im = spectrum.imaginary[k];
    power_of[k] = static_cast<float>(scale) * (re * re + im * im);
  }
  for (std::size_t k = 1; k < few; ++k) {
    const double f = static_cast<double>(k) * bin_hz;
    const double re = static_cast<double>(spectrum.real[k]);
    const double im = static_cast<double>(spectrum.imaginary[k]);
    if (f * record_s < kLeastPeriods) continue;
    // The transform counts time from the first sample: turn it to the middle.
    const double w = kTwoPi * f, c = std::cos(w * half_span), s = std::sin(w * half_span);
    const double yc = re * c - im * s, ys = -(re * s + im * c);
    const Sums sums = even ? even_sums(n, spacing, half_span, w) : direct_sums(problem, w);
    beside_trend[k] = static_cast<float>(drop(sums, n, line, true, yc, ys));
    power_of[k] = static_cast<float>(drop(sums, n, line, false,
                                          yc + slope * inverse_unit * (sums.xc - line.mean_x * sums.c),
                                          ys + slope * inverse_unit * (sums.xs - line.mean_x * sums.s)));
  }
  SineSeeds seeds;
  seeds.highest_hz = 0.5 / spacing;
  seeds.without_trend_hz = peaks(power_of, bin_hz);
  std::copy(beside_trend.begin(), beside_trend.end(), power_of.begin());
  seeds.with_trend_hz = peaks(power_of, bin_hz);
  return seeds;
}

}  // namespace cartwright
