#include "host/diagnose/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "host/diagnose/fit/block_covariance.hpp"
#include "host/diagnose/observe/rest.hpp"

namespace cartwright {
namespace {

/// Where the fit is: physics and noise, and what they predict.
struct Point {
  Model model;
  NoiseModel noise;
  CountedErrors errors;
  double value = 0;         // log-likelihood
  Eigen::MatrixXd columns;  // de/dp here; empty until asked for
};

constexpr double kMostLogStep = 1.0;  // of a logarithmic parameter in one iteration

double loss(double error, double outlier) {
  const double size = std::abs(error);
  return outlier <= 0 || size <= outlier ? error * error : outlier * (2 * size - outlier);
}

double sum_of(const std::vector<double>& errors, double outlier) {
  double sum = 0;
  for (const double e : errors) sum += loss(e, outlier);
  return sum;
}

double loss_slope_half(double error, double outlier) {
  return outlier <= 0 ? error : std::clamp(error, -outlier, outlier);
}

class Fitter {
 public:
  Fitter(const Session& session, const std::vector<FreeParameter>& free, const FitOptions& options)
      : session_(session), free_(free), options_(options) {}

  void evaluate(Point& at) const {
    at.errors = counted_errors(session_, at.model, at.noise, options_);
    at.value = log_likelihood(at.errors, options_.outlier_m);
  }

  Fit run(const Model& start, const NoiseModel& noise) const {
    Point at{start, bounded(noise, session_.rig), {}, 0, {}};
    evaluate(at);
    bool converged = false;
    for (int round = 0; round < options_.most_rounds && !converged; ++round) {
      const double before = at.value;
      improve_physics(at);
      if (options_.move_noise) improve_noise(at, round == 0 ? 0.5 : 0.2);
      converged = !options_.move_noise || at.value - before < options_.tolerance;
    }
    return finish(std::move(at), converged);
  }

  /// Compass search along and across the ridge of equal disturbance power, ratio^2 tau.
  void improve_noise(Point& at, double step) const {
    const double directions[4][2] = {{1, 0}, {-1, 0}, {-0.5, 1}, {0.5, -1}};
    while (step > options_.finest_noise_step) {
      bool improved = false;
      for (const auto& direction : directions) {
        Point there{at.model, at.noise, {}, 0, {}};
        there.noise.disturbance_per_reading_per_s2 *= std::exp(step * direction[0]);
        there.noise.correlation_time_s *= std::exp(2 * step * direction[1]);
        there.noise = bounded(there.noise, session_.rig);
        evaluate(there);
        if (there.value > at.value + 0.25 * options_.tolerance) {
          at = std::move(there);
          improved = true;
        }
      }
      if (!improved) step *= 0.4;
    }
  }

 private:
  const Eigen::MatrixXd& jacobian(Point& at) const {
    const std::vector<double>& errors = at.errors.error_m;
    const auto rows = static_cast<Eigen::Index>(errors.size());
    if (at.columns.rows() == rows) return at.columns;
    Eigen::MatrixXd& columns = at.columns;
    columns = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(free_.size()));
    const Eigen::Map<const Eigen::VectorXd> base(errors.data(), rows);
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const FreeParameter& p = free_[i];
      const double here = at.model[p.id];
      double step = options_.difference_step * (p.logarithmic ? here : std::max(p.scale, std::abs(here)));
      if (here + step > p.upper) step = -step;
      Model there = at.model;
      there.set(p.id, here + step);
      const std::vector<double> e = counted_errors(session_, there, at.noise, options_).error_m;
      columns.col(static_cast<Eigen::Index>(i)) =
          (Eigen::Map<const Eigen::VectorXd>(e.data(), rows) - base) / step;
    }
    return at.columns;
  }

  void improve_physics(Point& at) const {
    double damping = 1e-3;
    const auto n = static_cast<Eigen::Index>(free_.size());
    for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
      Eigen::MatrixXd columns = jacobian(at);
      for (Eigen::Index i = 0; i < n; ++i) {
        const FreeParameter& p = free_[static_cast<std::size_t>(i)];
        if (p.logarithmic) columns.col(i) *= at.model[p.id];
      }
      Eigen::MatrixXd h;
      Eigen::VectorXd g;
      normal_equations(columns, at.errors.error_m, h, g);
      // A parameter at its bound that the gradient pushes outward stays out of this step.
      for (Eigen::Index i = 0; i < n; ++i) {
        const FreeParameter& p = free_[static_cast<std::size_t>(i)];
        const double here = at.model[p.id];
        if ((here <= p.lower && g[i] > 0) || (here >= p.upper && g[i] < 0) || h(i, i) <= 0) {
          h.row(i).setZero();
          h.col(i).setZero();
          h(i, i) = 1;
          g[i] = 0;
        }
      }
      bool improved = false;
      double gained = 0;
      for (int attempt = 0; attempt < 5 && !improved; ++attempt) {
        Eigen::MatrixXd damped = h;
        damped.diagonal() *= 1 + damping;
        const Eigen::VectorXd step = damped.ldlt().solve(-g);
        Point there{at.model, at.noise, {}, 0, {}};
        for (Eigen::Index i = 0; i < n; ++i) {
          const FreeParameter& p = free_[static_cast<std::size_t>(i)];
          const double here = at.model[p.id];
          const double moved = p.logarithmic
                                   ? here * std::exp(std::clamp(step[i], -kMostLogStep, kMostLogStep))
                                   : here + step[i];
          there.model.set(p.id, std::clamp(moved, p.lower, p.upper));
        }
        evaluate(there);
        if (there.value > at.value) {
          gained = there.value - at.value;
          at = std::move(there);
          damping = std::max(damping * 0.1, 1e-9);
          improved = true;
        } else {
          damping = std::max(damping * 16, 1e-3);
        }
      }
      if (!improved || gained < 0.5 * options_.tolerance) return;
    }
  }

  void normal_equations(const Eigen::Ref<const Eigen::MatrixXd>& columns, std::span<const double> e,
                        Eigen::MatrixXd& h, Eigen::VectorXd& g) const {
    Eigen::VectorXd slope(columns.rows()), weight = Eigen::VectorXd::Ones(columns.rows());
    for (Eigen::Index k = 0; k < columns.rows(); ++k) {
      const double error = e[static_cast<std::size_t>(k)];
      slope[k] = loss_slope_half(error, options_.outlier_m);
      if (slope[k] != error) weight[k] = slope[k] / error;
    }
    h = columns.transpose() * weight.asDiagonal() * columns;
    g = columns.transpose() * slope;
  }

  Fit finish(Point at, bool converged) const {
    Fit result;
    const std::vector<double>& e = at.errors.error_m;
    result.model = at.model;
    result.noise = at.noise;
    result.free = free_;
    result.log_likelihood = at.value;
    result.rows = at.errors.rows;
    result.least_mean_square_m2 = at.errors.least_mean_square_m2;
    result.error_rms_m =
        std::sqrt(noise_variance_m2(sum_of(e, options_.outlier_m), result.rows, result.least_mean_square_m2));
    result.converged = converged;
    const Eigen::MatrixXd columns =
        options_.covariance ? jacobian(at) : Eigen::MatrixXd(static_cast<Eigen::Index>(e.size()), 0);
    std::size_t row = 0;
    const auto block_rows = static_cast<std::size_t>(std::max(1.0, kBlock_s * session_.rig.sample_rate_hz));
    const std::size_t skip = settling_rows(session_.rig);
    // Repeats go the same way past the same lines of the encoder: what they say at one time is said once.
    std::map<std::pair<std::string, std::size_t>, Block> by_time;
    for (const Recording& recording : session_.recordings) {
      const std::size_t rows = recording.size() > skip ? recording.size() - skip : 0;
      result.blocks.push_back((rows + block_rows - 1) / block_rows);
      for (std::size_t begin = 0; begin < rows; begin += block_rows) {
        const std::size_t end = std::min(begin + block_rows, rows);
        const auto n = static_cast<Eigen::Index>(end - begin), first = static_cast<Eigen::Index>(row);
        Block here;
        normal_equations(columns.middleRows(first, n), std::span(e).subspan(row, end - begin),
                         here.information, here.score);
        double sum = 0;
        for (std::size_t k = begin; k < end; ++k, ++row) sum += loss(e[row], options_.outlier_m);
        result.block_loss_m2.push_back(sum);
        const auto [block, is_new] = by_time.try_emplace({recording.original(), begin}, here);
        if (is_new) continue;
        block->second.score += here.score;
        block->second.information += here.information;
      }
    }
    std::vector<Block> blocks;
    for (auto& [time, block] : by_time) blocks.push_back(std::move(block));
    result.covariance = block_covariance(blocks, result.error_rms_m * result.error_rms_m);
    result.jacobian = columns;
    result.error_m = std::move(at.errors.error_m);
    return result;
  }

  const Session& session_;
  const std::vector<FreeParameter>& free_;
  const FitOptions& options_;
};

}  // namespace

double Fit::standard_error(Parameter parameter) const {
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (free[i].id == parameter && at < covariance.rows())
      return std::sqrt(std::max(covariance(at, at), 0.0));
  }
  return 0;
}

bool Fit::at_bound(Parameter parameter) const {
  if (model[parameter] == info(parameter).default_value) return false;
  for (const FreeParameter& p : free) {
    if (p.id == parameter) return model[p.id] <= p.lower || model[p.id] >= p.upper;
  }
  return false;
}

std::vector<PairedDifference> differences_by_recording(const Fit& better, const Fit& worse) {
  const double variance = better.error_rms_m * better.error_rms_m;
  std::vector<PairedDifference> out;
  std::size_t b = 0;
  for (const std::size_t count : better.blocks) {
    double nats = 0, squares = 0;
    for (const std::size_t end = b + count; b < end; ++b) {
      const double d = (worse.block_loss_m2[b] - better.block_loss_m2[b]) / (2 * variance);
      nats += d;
      squares += d * d;
    }
    out.push_back({nats, std::sqrt(squares)});
  }
  return out;
}

PairedDifference paired_difference(const Fit& better, const Fit& worse) {
  PairedDifference sum;
  for (const PairedDifference& one : differences_by_recording(better, worse)) {
    sum.nats += one.nats;
    sum.spread = std::hypot(sum.spread, one.spread);
  }
  return sum;
}

double noise_variance_m2(double sum, double rows, double least_mean_square) {
  return std::max({sum / rows, least_mean_square, 1e-300});
}

double log_likelihood(double sum, double rows, double least_mean_square) {
  const double v = noise_variance_m2(sum, rows, least_mean_square);
  return -0.5 * rows * (std::log(v) + sum / (rows * v) - 1);
}

double log_likelihood(const CountedErrors& errors, double outlier) {
  return log_likelihood(sum_of(errors.error_m, outlier), errors.rows, errors.least_mean_square_m2);
}

CountedErrors counted_errors(const Session& session, const Model& model, const NoiseModel& noise,
                             const FitOptions& options) {
  std::vector<double> all;
  double log_spread = 0, counted = 0;
  const double half_count = 0.5 * session.rig.encoder_resolution_m;
  std::size_t rows = 0;
  for (const Recording& recording : session.recordings) rows += recording.size();
  all.reserve(rows);
  ObserverOptions observer;
  observer.step_s = options.step_s;
  observer.coarsely = options.coarsely;
  const ObserverGains gains = observer_gains(noise, session.rig.period_s(), options.damping_per_s);
  const std::size_t skip = settling_rows(session.rig);
  const std::vector<Observation> observations = observe(model, gains, session, observer, options.threads);
  const std::vector<std::vector<bool>> rests = rows_at_rest(session, options.rest_s);
  for (std::size_t n = 0; n < observations.size(); ++n) {
    const Observation& seen = observations[n];
    for (std::size_t k = skip; k < seen.error_m.size(); ++k) {
      if (rests[n][k]) {  // the reading is no nearer than that
        const double e = seen.error_m[k];
        all.push_back(e - std::clamp(e, -half_count, half_count));
        continue;
      }
      ++counted;
      if (seen.spread.empty()) {
        all.push_back(seen.error_m[k]);
      } else {
        all.push_back(seen.error_m[k] / seen.spread[k]);
        log_spread += std::log(seen.spread[k]);
      }
    }
  }
  double variance_ratio = gains.settled.error_variance_ratio;
  // Errors of uneven spread count by it; times its geometric mean, so that log L counts sum(log spread) too.
  if (log_spread != 0) {
    const double mean = std::exp(log_spread / std::max(counted, 1.0));
    for (double& e : all) e *= mean;
    variance_ratio = mean * mean;
  }
  const double count = session.rig.encoder_resolution_m;
  return {std::move(all), std::max(counted, 1.0), variance_ratio * count * count / 12};
}

FitOptions options_for(const Session& session, const Model& nominal) {
  FitOptions options;
  options.damping_per_s = linear_damping(nominal);
  options.rest_s = time_at_rest_s(session);
  return options;
}

NoiseModel search_noise(const Session& session, const Model& model, const FitOptions& options) {
  NoiseModel best;
  double most = -1e300;
  for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
    const NoiseModel tried{ratio, 0.003};
    const double value = log_likelihood(counted_errors(session, model, tried, options), options.outlier_m);
    if (value > most) most = value, best = tried;
  }
  return best;
}

Fit fit(const Session& session, const Model& start, const NoiseModel& noise,
        const std::vector<FreeParameter>& free, const FitOptions& options) {
  return Fitter(session, free, options).run(start, noise);
}

}  // namespace cartwright
