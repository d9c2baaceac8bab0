#include "host/relay/sine_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/relay/angle.hpp"
#include "host/relay/fft.hpp"
#include "host/relay/periodogram.hpp"
#include "host/relay/vector_sums.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

constexpr double kConfidence = 0.95;
/// From here on in periods, a sine is not taken for a part of a slower one on a slope.
constexpr double kPeriodsWithoutDoubt = 1.5;

/// Density of a residual relative to white noise of the same power, over frequency. From a transform of the
/// residual on an even grid, which is near enough for what is a mean over some dozen bins.
class RelativeDensity {
 public:
  RelativeDensity(const SineProblem& problem, const std::vector<double>& e, double power)
      : record_s_(2 * problem.half_span_s()), samples_(static_cast<double>(problem.size())) {
    EvenGrid grid(problem);
    grid.coarsen(problem);
    std::vector<double> scaled(e);
    const double unit = 1 / std::sqrt(power / samples_);
    for (double& value : scaled) value *= unit;
    std::size_t size = 64;
    while (size < grid.size) size *= 2;  // a mean over bins needs none in between
    spectrum_ = real_spectrum(grid.spread(problem, scaled), size);
    bin_hz_ = 1 / (static_cast<double>(size) * grid.spacing_s);
  }

  /// Mean over the bins around `centre_hz`, one record length apart: 1 for white noise.
  double around(double centre_hz, double sine_hz, double& bins) const {
    const double highest_hz = 0.5 * (samples_ - 1) / record_s_;
    double mean = 0;
    bins = 0;
    for (int j = -8; j <= 8; ++j) {
      const double f = centre_hz + j / record_s_;
      if (f < 0 || f > highest_hz) continue;
      const auto k = std::min(static_cast<std::size_t>(std::lround(f / bin_hz_)), spectrum_.real.size() - 1);
      // The fit has emptied the bins at its own frequency and at zero.
      const double at_hz = static_cast<double>(k) * bin_hz_;
      if (at_hz * record_s_ < 0.9 || std::abs(at_hz - sine_hz) * record_s_ < 1.5) continue;
      const double re = static_cast<double>(spectrum_.real[k]),
                   im = static_cast<double>(spectrum_.imaginary[k]);
      mean += (re * re + im * im) / samples_;
      ++bins;
    }
    return bins > 0 ? mean / bins : 1.0;
  }

 private:
  double record_s_, samples_, bin_hz_ = 1;
  Spectrum spectrum_;
};

/// Whether the first lags of the autocorrelation stay within what white noise does (3.3 standard errors).
bool looks_white(const std::vector<double>& e) {
  constexpr std::size_t kLags = 4;
  if (e.size() < 4 * kLags) return true;
  const double limit = 3.3 * sum_of_squares(e.data(), e.size()) / std::sqrt(static_cast<double>(e.size()));
  for (std::size_t lag = 1; lag <= kLags; ++lag) {
    if (std::abs(sum_of_products(e.data(), e.data() + lag, e.size() - lag)) > limit) return false;
  }
  return true;
}

/// Covariance of the linear values alone, at a known frequency.
Eigen::MatrixXd with_known_frequency(const Eigen::MatrixXd& covariance) {
  const Eigen::Index last = covariance.rows() - 1;
  Eigen::MatrixXd out = covariance;
  out -= covariance.col(last) * covariance.row(last) / covariance(last, last);
  out.row(last).setZero();
  out.col(last).setZero();
  return out;
}

double wrapped(double angle_rad) {
  const double turned = std::remainder(angle_rad, kTwoPi);
  return turned <= -std::numbers::pi ? turned + kTwoPi : turned;
}

struct Polar {
  double amplitude, phase_rad;             ///< of a sine, at t = 0
  Eigen::VectorXd amplitude_by, phase_by;  ///< gradients with respect to (linear, 2 pi f half_span)
};

/// a cos + b sin at the middle of the record as A sin(k 2 pi f t + phase).
Polar polar(const SineProblem& problem, const SineProblem::Point& point, Eigen::Index constants, int order) {
  const Eigen::Index ia = constants + 2 * (order - 1), ib = ia + 1;
  const double a = point.linear(ia), b = point.linear(ib);
  Polar p;
  p.amplitude = std::hypot(a, b);
  p.phase_rad = wrapped(std::atan2(a, b) - kTwoPi * order * point.frequency_hz * problem.centre_s());
  p.amplitude_by = p.phase_by = Eigen::VectorXd::Zero(point.covariance.rows());
  if (p.amplitude > 0) {
    p.amplitude_by(ia) = a / p.amplitude;
    p.amplitude_by(ib) = b / p.amplitude;
    p.phase_by(ia) = b / (p.amplitude * p.amplitude);
    p.phase_by(ib) = -a / (p.amplitude * p.amplitude);
  }
  p.phase_by(point.covariance.rows() - 1) = -order * problem.centre_s() / problem.half_span_s();
  return p;
}

double variance(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& by) {
  return by.dot(covariance * by);
}

Estimate amplitude_estimate(double value, double half_width) {
  return {value, std::max(0.0, value - half_width), value + half_width};
}

/// A phase known to worse than half a turn is not known at all.
Estimate phase_estimate(double value, double half_width) {
  return half_width < std::numbers::pi ? Estimate::within(value, half_width) : Estimate{value};
}

void include(Estimate& estimate, double low, double high) {
  estimate.low = std::min(estimate.low, low);
  estimate.high = std::max(estimate.high, high);
}

}  // namespace

NoiseColour noise_colour(const SineProblem& problem, const std::vector<double>& residual, double frequency_hz,
                         double free_values) {
  NoiseColour colour;
  colour.degrees = std::max(1.0, static_cast<double>(problem.size()) - free_values);
  const double power = sum_of_squares(residual.data(), residual.size());
  // What rounding leaves has no colour that matters.
  if (power <= 1e-24 * problem.cost_without_sine(false) || looks_white(residual)) return colour;
  const RelativeDensity density(problem, residual, power);
  double bins = 0, bins_at_zero = 0;
  colour.near_sine = std::max(1.0, density.around(frequency_hz, frequency_hz, bins));
  colour.near_zero = std::max(1.0, density.around(0, frequency_hz, bins_at_zero));
  const double fewest = std::max(1.0, std::min(bins, bins_at_zero));
  colour.degrees = std::min(colour.degrees, 2 * fewest);
  return colour;
}

double quantisation_variance(std::span<const double> y, double amplitude, double residual_rms) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < y.size() && step >= 2 * residual_rms; ++i) {
    const double change = std::abs(y[i] - y[i - 1]);
    if (change > 1e-9 * amplitude) step = std::min(step, change);
  }
  if (!std::isfinite(step) || step < 2 * residual_rms) return 0;
  for (std::size_t i = 1; i < y.size(); ++i) {
    const double steps = (y[i] - y[0]) / step;
    if (std::abs(steps - std::round(steps)) > 0.01) return 0;
  }
  return step * step / 6 * std::min(1.0, step / amplitude);
}

void fill_estimates(const SineProblem& problem, const SineProblem::Point& point, bool with_trend,
                    bool fixed_frequency, const NoiseColour& colour, double extra_variance, SineFit& fit) {
  const Eigen::Index constants = with_trend ? 2 : 1;
  const Eigen::Index last = point.covariance.rows() - 1;
  const Eigen::MatrixXd covariance =
      fixed_frequency ? with_known_frequency(point.covariance) : point.covariance;
  const double squares = sum_of_squares(fit.residual.data(), fit.residual.size());
  const double n = static_cast<double>(problem.size());
  const double free_values = static_cast<double>(fixed_frequency ? last : last + 1);
  const double noise = squares / std::max(1.0, n - free_values);
  const double t = student_t(kConfidence, colour.degrees);
  const auto half_width = [&](double unit_variance, double factor, double extra) {
    return t * std::sqrt(std::max(0.0, unit_variance) * noise * factor + extra);
  };
  fit.rms = std::sqrt(squares / n);
  fit.middle_s = problem.centre_s();
  fit.periods = point.frequency_hz * 2 * problem.half_span_s() * n / (n - 1);
  fit.offset = Estimate::within(problem.mean() + point.linear(0),
                                half_width(covariance(0, 0), colour.near_zero, 0.5 * extra_variance));
  if (with_trend) {
    fit.trend_per_s =
        Estimate::within(point.linear(1) / problem.half_span_s(),
                         half_width(covariance(1, 1), colour.near_zero, 0) / problem.half_span_s());
  }
  const double to_hz = 1 / (kTwoPi * problem.half_span_s());
  fit.frequency_hz = fixed_frequency
                         ? Estimate{point.frequency_hz}
                         : Estimate::within(point.frequency_hz,
                                            to_hz * half_width(covariance(last, last), colour.near_sine, 0));
  fit.harmonics.clear();
  for (int order = 1; order <= problem.harmonics(); ++order) {
    const Polar p = polar(problem, point, constants, order);
    const Estimate amplitude = amplitude_estimate(
        p.amplitude, half_width(variance(covariance, p.amplitude_by), colour.near_sine, extra_variance));
    const Estimate phase =
        phase_estimate(p.phase_rad, half_width(variance(covariance, p.phase_by), colour.near_sine,
                                               extra_variance / std::max(p.amplitude * p.amplitude, 1e-300)));
    if (order == 1) {
      fit.amplitude = amplitude;
      fit.phase_rad = phase;
    } else {
      fit.harmonics.push_back({order, amplitude, phase});
    }
  }
}

namespace {

/// One model, with or without a trend, over the frequencies tried: what it cannot exclude widens `fit`.
class Profile {
 public:
  Profile(const SineProblem& problem, bool with_trend, const NoiseColour& colour)
      : problem_(problem), with_trend_(with_trend), colour_(colour) {}

  void add(double frequency_hz, const Eigen::MatrixXd& products) {
    points_.push_back(problem_.solve(frequency_hz, products, with_trend_));
    least_cost_ = std::min(least_cost_, points_.back().cost);
  }

  /// Returns the lowest frequency that is not excluded.
  double widen(double lowest_hz, SineFit& fit) const {
    const double free_values = static_cast<double>(points_.front().covariance.rows());
    const double noise = least_cost_ / std::max(1.0, static_cast<double>(problem_.size()) - free_values);
    const double t = student_t(kConfidence, colour_.degrees);
    const double allowance = t * t * noise * colour_.near_sine;
    for (const SineProblem::Point& point : points_) {
      const double left = std::min(1.0, 1 - (point.cost - least_cost_) / allowance);
      if (!(left >= 0)) continue;
      lowest_hz = std::min(lowest_hz, point.frequency_hz);
      include(fit.frequency_hz, point.frequency_hz, point.frequency_hz);
      // What is left of the allowance is there for the linear values at this frequency.
      const Eigen::MatrixXd covariance = with_known_frequency(point.covariance);
      const auto reach = [&](const Eigen::VectorXd& by) {
        return std::sqrt(std::max(0.0, variance(covariance, by)) * allowance * left);
      };
      const Polar p = polar(problem_, point, with_trend_ ? 2 : 1, 1);
      include(fit.amplitude, std::max(0.0, p.amplitude - reach(p.amplitude_by)),
              p.amplitude + reach(p.amplitude_by));
      if (fit.phase_rad.has_interval()) {
        const double phase = fit.phase_rad.value + wrapped(p.phase_rad - fit.phase_rad.value);
        include(fit.phase_rad, phase - reach(p.phase_by), phase + reach(p.phase_by));
      }
      const double offset = problem_.mean() + point.linear(0);
      const double offset_reach =
          std::sqrt(std::max(0.0, covariance(0, 0)) * t * t * noise * colour_.near_zero * left);
      include(fit.offset, offset - offset_reach, offset + offset_reach);
    }
    return lowest_hz;
  }

 private:
  const SineProblem& problem_;
  bool with_trend_;
  NoiseColour colour_;
  std::vector<SineProblem::Point> points_;
  double least_cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double widen_to_profile(const SineProblem& problem, const SineProblem::Point& best, bool with_trend,
                        const NoiseColour& colour, double highest_hz, SineFit& fit) {
  const double record_s = 2 * problem.half_span_s();
  const double half_width = 0.5 * (fit.frequency_hz.high - fit.frequency_hz.low);
  std::vector<double> frequencies{best.frequency_hz};
  for (int i = -40; i <= 40; ++i) frequencies.push_back(best.frequency_hz + 0.1 * i * half_width);
  for (int i = 4; i <= 100; ++i) frequencies.push_back(0.05 * i / record_s);
  // So near one period, a part of a period on a slope looks like a whole one.
  const bool slope_too = !with_trend && fit.periods < kPeriodsWithoutDoubt;
  Profile chosen(problem, with_trend, colour), on_slope(problem, true, colour);
  for (const double f : frequencies) {
    if (f * record_s < 0.2 || f > highest_hz) continue;
    const Eigen::MatrixXd products = problem.products(f);
    chosen.add(f, products);
    if (slope_too) on_slope.add(f, products);
  }
  double lowest = chosen.widen(best.frequency_hz, fit);
  if (slope_too) lowest = on_slope.widen(lowest, fit);
  if (fit.phase_rad.has_interval() && fit.phase_rad.high - fit.phase_rad.low >= kTwoPi) {
    fit.phase_rad = Estimate{fit.phase_rad.value};
  }
  return lowest;
}

}  // namespace cartwright
