#include "host/relay/sinefit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host/relay/angle.hpp"
#include "host/relay/periodogram.hpp"
#include "host/relay/sine_intervals.hpp"
#include "host/relay/sine_problem.hpp"
#include "host/relay/vector_sums.hpp"
#include "host/vector_clones.hpp"

namespace cartwright {
namespace {

constexpr int kMostHarmonics = 20;
/// A trend belongs to the model from this many standard errors on: by chance once in 2000 records.
constexpr double kTrendErrors = 3.5;
/// Probability, over all frequencies looked at, that noise alone gives as high a peak.
constexpr double kFalseAlarm = 1e-6;
/// Below this many periods the cost is no parabola in frequency and intervals come from its profile.
constexpr double kFewPeriods = 3;

struct Candidate {
  SineProblem::Point point;
  Eigen::MatrixXd products;  ///< at the last frequency evaluated
  bool with_trend = false;
};

/// Gauss-Newton in frequency with step halving. Stops once the step is a small part of the standard error,
/// and takes that last step in all values at once: what is left is of second order in it.
Candidate refine(const SineProblem& problem, double start_hz, double highest_hz, bool with_trend) {
  constexpr double kLongestStep_rad = 0.8, kNegligible_rad = 1e-6, kNegligibleErrors = 0.05;
  Candidate best;
  best.with_trend = with_trend;
  best.products = problem.products(start_hz);
  best.point = problem.solve(start_hz, best.products, with_trend);
  const double to_hz = 1 / (kTwoPi * problem.half_span_s());
  const double lowest_hz = 0.02 * to_hz;
  const double rounding = 1e-13 * problem.cost_without_sine(false);
  for (int iteration = 0; iteration < 50; ++iteration) {
    SineProblem::Point& now = best.point;
    const Eigen::Index last = now.covariance.rows() - 1;
    const double spread =
        std::sqrt(now.cost / static_cast<double>(problem.size()) * now.covariance(last, last));
    if (std::abs(now.step_rad) <= std::max(std::min(kNegligibleErrors * spread, 0.01), kNegligible_rad)) {
      now.linear += now.covariance.col(last).head(last) * (now.step_rad / now.covariance(last, last));
      now.frequency_hz += now.step_rad * to_hz;
      break;
    }
    double step = std::clamp(now.step_rad, -kLongestStep_rad, kLongestStep_rad);
    bool lower = false;
    for (int halving = 0; halving < 12 && !lower; ++halving, step *= 0.5) {
      const double f = std::clamp(now.frequency_hz + step * to_hz, lowest_hz, highest_hz);
      Eigen::MatrixXd products = problem.products(f);
      SineProblem::Point next = problem.solve(f, products, with_trend);
      lower = next.cost <= now.cost + rounding;
      if (lower) {
        best.point = std::move(next);
        best.products = std::move(products);
      }
    }
    if (!lower) break;
  }
  return best;
}

/// Sum of squares that offset, trend and sine would reach together from where the fit without trend ended.
double cost_with_trend(const SineProblem& problem, const Candidate& plain) {
  const auto point = problem.solve(plain.point.frequency_hz, plain.products, true);
  const Eigen::Index last = point.covariance.rows() - 1;
  return point.cost - point.step_rad * point.step_rad / point.covariance(last, last);
}

std::optional<Candidate> best_of(const SineProblem& problem, const std::vector<double>& seeds_hz,
                                 double highest_hz, bool with_trend) {
  std::optional<Candidate> best;
  for (const double seed : seeds_hz) {
    Candidate candidate = refine(problem, seed, highest_hz, with_trend);
    if (!best || candidate.point.cost < best->point.cost) best = std::move(candidate);
  }
  return best;
}

bool trend_is_clear(const SineProblem& problem, double cost_without, double cost_with, double colour) {
  const double degrees = static_cast<double>(problem.size()) - 4 - 2 * problem.harmonics();
  const double gain = cost_without - cost_with;
  return gain > 1e-12 * problem.cost_without_sine(false) &&
         gain * std::max(1.0, degrees) > kTrendErrors * kTrendErrors * colour * std::max(cost_with, 0.0);
}

Result<Candidate> find_sine(const SineProblem& problem, double& highest_hz) {
  const auto seeds = sine_seeds(problem);
  if (!seeds) return tl::unexpected(seeds.error());
  highest_hz = seeds->highest_hz;
  auto plain = best_of(problem, seeds->without_trend_hz, highest_hz, false);
  bool same_start = !seeds->without_trend_hz.empty() && !seeds->with_trend_hz.empty();
  if (same_start) {
    const double apart = seeds->without_trend_hz.front() - seeds->with_trend_hz.front();
    same_start = std::abs(apart) * problem.half_span_s() < 0.1;
  }
  if (plain && same_start &&
      !trend_is_clear(problem, plain->point.cost, cost_with_trend(problem, *plain), 1)) {
    return *std::move(plain);
  }
  auto trended = best_of(problem, seeds->with_trend_hz, highest_hz, true);
  if (!plain && !trended) return failure("no oscillation: the spectrum has no peak");
  if (!trended) return *std::move(plain);
  if (plain && !trend_is_clear(problem, plain->point.cost, trended->point.cost, 1)) return *std::move(plain);
  if (plain) {
    const auto colour =
        noise_colour(problem, problem.residual(trended->point, true), trended->point.frequency_hz, 5);
    if (!trend_is_clear(problem, plain->point.cost, trended->point.cost, colour.near_zero))
      return *std::move(plain);
  }
  return *std::move(trended);
}

Candidate fit_known_frequency(const SineProblem& problem, double frequency_hz) {
  Candidate plain;
  plain.products = problem.products(frequency_hz);
  plain.point = problem.solve(frequency_hz, plain.products, false);
  Candidate trended = plain;
  trended.with_trend = true;
  trended.point = problem.solve(frequency_hz, plain.products, true);
  if (!trend_is_clear(problem, plain.point.cost, trended.point.cost, 1)) return plain;
  const auto colour = noise_colour(problem, problem.residual(trended.point, true), frequency_hz, 4);
  return trend_is_clear(problem, plain.point.cost, trended.point.cost, colour.near_zero) ? trended : plain;
}

/// Finite and increasing, without a branch so that it vectorises.
CARTWRIGHT_VECTOR_CLONES bool all_fine(std::span<const double> t_s, std::span<const double> y) {
  constexpr double kGreatest = std::numeric_limits<double>::max();
  int wrong = 0;
  for (std::size_t i = 0; i < y.size(); ++i) wrong |= !(std::abs(y[i]) <= kGreatest);
  for (std::size_t i = 1; i < t_s.size(); ++i) wrong |= !(t_s[i] > t_s[i - 1]);
  return wrong == 0 && std::isfinite(t_s.front()) && std::isfinite(t_s.back());
}

Result<void> check(std::span<const double> t_s, std::span<const double> y, const SineFitOptions& options) {
  if (options.harmonics < 1 || options.harmonics > kMostHarmonics) {
    return failure(
        fmt::format("{} harmonics asked for; 1 to {} can be fitted", options.harmonics, kMostHarmonics));
  }
  const std::size_t least = 6 + 2 * static_cast<std::size_t>(options.harmonics);
  if (t_s.size() != y.size() || t_s.size() < least) {
    return failure(fmt::format("{} rows; a sine fit needs at least {}", t_s.size(), least));
  }
  if (!all_fine(t_s, y)) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!std::isfinite(t_s[i]) || !std::isfinite(y[i])) return failure("a value is not a finite number");
      if (i > 0 && t_s[i] <= t_s[i - 1])
        return failure(fmt::format("time does not increase at t = {} s", t_s[i]));
    }
  }
  if (options.frequency_hz && !(*options.frequency_hz > 0 && std::isfinite(*options.frequency_hz))) {
    return failure(fmt::format("frequency {} Hz; a number above 0 is needed", *options.frequency_hz));
  }
  return {};
}

/// Whether the drop of the sum of squares could be the luckiest of all frequencies in plain noise.
bool could_be_noise(const SineProblem& problem, const Candidate& found, const NoiseColour& colour) {
  const double n = static_cast<double>(problem.size());
  const double degrees = n - static_cast<double>(found.point.covariance.rows());
  const double ratio = found.point.cost / problem.cost_without_sine(found.with_trend);
  return 0.5 * degrees / colour.near_sine * std::log(ratio) + std::log(n) > std::log(kFalseAlarm);
}

}  // namespace

double SineFit::at(double t_s) const {
  const double angle = kTwoPi * frequency_hz.value * t_s;
  double y = offset.value + amplitude.value * std::sin(angle + phase_rad.value);
  if (trend_per_s) y += trend_per_s->value * (t_s - middle_s);
  for (const SineHarmonic& h : harmonics)
    y += h.amplitude.value * std::sin(h.order * angle + h.phase_rad.value);
  return y;
}

Result<SineFit> sinefit(std::span<const double> t_s, std::span<const double> y,
                        const SineFitOptions& options) {
  const auto checked = check(t_s, y, options);
  if (!checked) return tl::unexpected(checked.error());
  const SineProblem problem(t_s, y, options.harmonics);
  const double scale = problem.mean() * problem.mean() * static_cast<double>(y.size());
  if (!(problem.cost_without_sine(false) > 1e-26 * scale) || problem.cost_without_sine(false) == 0) {
    return failure("no oscillation: the values are all the same");
  }
  double highest_hz = std::numeric_limits<double>::infinity();
  const auto found = options.frequency_hz
                         ? Result<Candidate>(fit_known_frequency(problem, *options.frequency_hz))
                         : find_sine(problem, highest_hz);
  if (!found) return tl::unexpected(found.error());
  const SineProblem::Point& point = found->point;
  SineFit fit;
  fit.residual = problem.residual(point, found->with_trend);
  const NoiseColour colour =
      noise_colour(problem, fit.residual, point.frequency_hz, static_cast<double>(point.covariance.rows()));
  const double amplitude =
      std::hypot(point.linear(found->with_trend ? 2 : 1), point.linear(found->with_trend ? 3 : 2));
  const double power = sum_of_squares(fit.residual.data(), fit.residual.size());
  const double extra = quantisation_variance(y, amplitude, std::sqrt(power / static_cast<double>(y.size())));
  fill_estimates(problem, point, found->with_trend, options.frequency_hz.has_value(), colour, extra, fit);
  if (options.frequency_hz) return fit;
  if (could_be_noise(problem, *found, colour)) {
    return failure(
        fmt::format("no sine stands out of the noise: the best, at {:.6g} Hz with amplitude {:.3g}, leaves "
                    "rms {:.3g}; a longer record or a known frequency is needed",
                    point.frequency_hz, amplitude, fit.rms));
  }
  const auto too_few = [&fit](double lowest_periods) {
    const std::string less =
        lowest_periods < fit.periods ? fmt::format(", and it could be {:.2f}", lowest_periods) : "";
    return failure(
        fmt::format("about {:.2f} of a period in the record{}; a sine fit needs at least one whole period",
                    fit.periods, less));
  };
  if (fit.periods < 1) return too_few(fit.periods);
  if (fit.periods < kFewPeriods) {
    const double lowest_hz = widen_to_profile(problem, point, found->with_trend, colour, highest_hz, fit);
    const double lowest_periods = fit.periods * lowest_hz / point.frequency_hz;
    if (lowest_periods < 0.5) return too_few(lowest_periods);
  }
  return fit;
}

}  // namespace cartwright
