#include "host/diagnose/locate/locate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/fit/influence.hpp"
#include "host/diagnose/locate/axes.hpp"
#include "host/diagnose/observe/rest.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

/// Upper point of a chi-square at a normal quantile, halved to nats (Wilson-Hilferty).
double chance_bar(double freedom, double upper_normal) {
  const double a = 2 / (9 * freedom);
  const double root = 1 - a + upper_normal * std::sqrt(a);
  return 0.5 * freedom * root * root * root;
}

/// Of a map's directions only those are shown that the data tell this well beside the best told one.
constexpr double kLeastTold = 1e-3;

/// What the model saw beside a session, whose rows are sorted into the bins of all axes.
struct Observed {
  std::vector<Observation> seen;
  std::vector<AxisBins> axes;
  std::vector<std::vector<bool>> rests;
};

Observed observed(const Session& session, const Model& model, const ObserverGains& gains,
                  const FitOptions& options) {
  ObserverOptions keep;
  keep.keep_states = true;
  Observed out{
      observe(model, gains, session, keep, options.threads), {}, rows_at_rest(session, options.rest_s)};
  out.axes = axes_of(session, out.seen);
  return out;
}

/// A push in each bin of an axis, as what it would add to the errors.
struct PushesInBins {
  Eigen::MatrixXd columns;  ///< of unit pushes, less what the model's own numbers explain
  Eigen::MatrixXd products;
  Eigen::LDLT<Eigen::MatrixXd> solver;  ///< of `products`, made regular

  /// By how much the best pushes would lower the sum of the squares of errors.
  double explained_m2(const Eigen::VectorXd& errors) const {
    const Eigen::VectorXd g = columns.transpose() * errors;
    return g.dot(solver.solve(g));
  }
};

PushesInBins pushes_in_bins(const Session& session, const AxisBins& axis,
                            const std::vector<std::vector<bool>>& rests, const ObserverGains& gains,
                            const Basis& basis, double damping) {
  PushesInBins pushes;
  Eigen::MatrixXd& columns = pushes.columns;
  columns.resize(basis.e.size(), static_cast<Eigen::Index>(axis.edges.size()) - 1);
  const std::size_t skip = settling_rows(session.rig);
  for (Eigen::Index b = 0; b < columns.cols(); ++b) {
    Eigen::Index row = 0;
    for (std::size_t n = 0; n < session.recordings.size(); ++n) {
      Influence influence(gains, session.rig.period_s(), damping);
      for (std::size_t k = 1; k < session.recordings[n].size(); ++k) {
        const double push = axis.bin[n][k] == b ? axis.direction[n][k] : 0.0;
        const double e = influence.step(k, push, 0);
        if (k >= skip) columns(row++, b) = rests[n][k] ? 0 : e;
      }
    }
  }
  basis.project_out(columns);
  pushes.products = columns.transpose() * columns;
  Eigen::MatrixXd regular = pushes.products;
  regular.diagonal() *= 1 + 1e-9;  // a bin that the model's own numbers already span
  pushes.solver.compute(regular);
  return pushes;
}

void map_pushes(const AxisBins& axis, const PushesInBins& pushes, const Basis& basis, double looks,
                AxisMap& map) {
  const Eigen::Index bins = pushes.columns.cols();
  // What the model's own numbers could do as well (a constant, beside a free constant force) is not shown:
  // pushes are the smallest that explain the errors.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(pushes.products);
  const double least = kLeastTold * axes.eigenvalues().maxCoeff();
  const Eigen::VectorXd inverse_of_told =
      (axes.eigenvalues().array() > least).select(1 / axes.eigenvalues().array(), 0);
  const Eigen::MatrixXd inverse =
      axes.eigenvectors() * inverse_of_told.asDiagonal() * axes.eigenvectors().transpose();
  const Eigen::VectorXd x = inverse * (pushes.columns.transpose() * basis.e);
  const double ee = basis.squares_m2;
  map.gain = basis.gain(std::max(ee - pushes.explained_m2(basis.e), 1e-9 * ee));
  constexpr double kUpperNormal = 4.0;  // 3e-5 per axis, about a dozen axes: 1 in 2000 sessions
  map.bar = chance_bar(static_cast<double>(bins), kUpperNormal);
  // Simultaneous 95 % band: normal quantile at 0.025/looks, by its asymptotic series.
  const double l = std::log(40 * looks);
  const double quantile = std::sqrt(2 * l - std::log(4 * std::numbers::pi * l));
  for (Eigen::Index b = 0; b < bins; ++b) {
    const auto at = static_cast<std::size_t>(b);
    map.low.push_back(axis.edges[at]);
    map.high.push_back(axis.edges[at + 1]);
    map.push_m_per_s2.push_back(x[b]);
    map.band_m_per_s2.push_back(quantile * std::sqrt(std::max(inverse(b, b), 0.0) * basis.variance_m2));
  }
}

/// By how much chance must be exceeded where a cart that is exactly the model gains so much on an axis.
double beyond_chance(const AxisMap& map, double alike_gain) {
  if (map.low.empty()) return 1;
  return std::max(1.0, kStandsOutFromAlike * (alike_gain - map.mean()) / (map.bar - map.mean()));
}

/// How many times what chance gains on average such a cart gains, on the middle one of its axes: errors that
/// have colour do it on most, states that follow errors on one or two.
double dispersion_of_alike(const std::vector<AxisMap>& axes) {
  std::vector<double> times;
  for (const AxisMap& map : axes) {
    if (!map.low.empty()) times.push_back(map.alike_gain / map.mean());
  }
  if (times.empty()) return 1;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// Pairs of repeats have the same physics left out and different noise.
void compare_repeats(const Session& session, const Fit& fit, Location& location) {
  constexpr double kSmooth_s = 0.02;
  const auto span = static_cast<std::size_t>(std::max(1.0, kSmooth_s * session.rig.sample_rate_hz));
  const std::size_t skip = settling_rows(session.rig);
  std::vector<std::vector<double>> smooth;
  std::size_t first = 0;
  for (const Recording& r : session.recordings) {
    const std::size_t rows = r.size() > skip ? r.size() - skip : 0;
    std::vector<double> means;
    for (std::size_t k = 0; k + span <= rows; k += span) {
      double sum = 0;
      for (std::size_t j = 0; j < span; ++j) sum += fit.error_m[first + k + j];
      means.push_back(sum / static_cast<double>(span));
    }
    smooth.push_back(std::move(means));
    first += rows;
  }
  double cross = 0, power = 0, count = 0;
  for (std::size_t a = 0; a < smooth.size(); ++a) {
    for (std::size_t b = a + 1; b < smooth.size(); ++b) {
      if (session.recordings[a].original() != session.recordings[b].original()) continue;
      const std::size_t most = std::min(smooth[a].size(), smooth[b].size());
      for (std::size_t k = 0; k < most; ++k) {
        cross += smooth[a][k] * smooth[b][k];
        power += 0.5 * (smooth[a][k] * smooth[a][k] + smooth[b][k] * smooth[b][k]);
      }
      count += static_cast<double>(most);
    }
  }
  if (count < 10) return;
  location.repeat_correlation = cross / power;
  location.repeat_z = location.repeat_correlation * std::sqrt(count);
}

}  // namespace

std::vector<double> AxisMap::stretch() const {
  std::vector<double> best;
  double most = 0;
  for (std::size_t i = 0; i < low.size();) {
    std::size_t j = i;
    double excess = 0;
    while (j < low.size() && std::abs(push_m_per_s2[j]) > band_m_per_s2[j] &&
           (j == i || (push_m_per_s2[j] > 0) == (push_m_per_s2[i] > 0))) {
      const double z = push_m_per_s2[j] / band_m_per_s2[j];
      excess += z * z;
      ++j;
    }
    if (excess > most) most = excess, best = {low[i], high[j - 1]};
    i = std::max(j, i + 1);
  }
  return best;
}

Location locate(const Session& session, const Fit& fit, const Alike& alike, const FitOptions& options) {
  Location location;
  const unsigned threads = options.threads;
  const ObserverGains gains = observer_gains(fit.noise, session.rig.period_s(), options.damping_per_s);
  const Observed here = observed(session, fit.model, gains, options);
  const Observed there = observed(alike.session, fit.model, gains, options);
  const std::vector<AxisBins>& axes = here.axes;

  const Basis basis = basis_of(fit, options.outlier_m);
  Eigen::VectorXd errors_of_alike = Eigen::Map<const Eigen::VectorXd>(
      alike.error_m.data(), static_cast<Eigen::Index>(alike.error_m.size()));
  basis.project_out(errors_of_alike);

  double looks = 0;
  for (const AxisBins& axis : axes) looks += static_cast<double>(axis.edges.size());
  location.axes.resize(axes.size());
  std::vector<double> coloured(axes.size());
  parallel_for(axes.size(), threads, [&](std::size_t i) {
    AxisMap& map = location.axes[i];
    map.axis = axes[i].axis, map.parity = axes[i].parity, map.names = axes[i].names;
    const auto gain_of_alike = [&](const PushesInBins& pushes) {
      return 0.5 * pushes.explained_m2(errors_of_alike) / basis.variance_m2;
    };
    const double damping = options.damping_per_s;
    if (axes[i].edges.size() >= 2) {
      const PushesInBins pushes = pushes_in_bins(session, axes[i], here.rests, gains, basis, damping);
      map_pushes(axes[i], pushes, basis, looks, map);
      coloured[i] = gain_of_alike(pushes);
    }
    if (there.axes[i].edges.size() >= 2)
      map.alike_gain =
          gain_of_alike(pushes_in_bins(alike.session, there.axes[i], there.rests, gains, basis, damping));
  });

  // Rounding is no white noise where a cart creeps and stands: what stands out must stand out from that too.
  // That its errors have colour shows on any axis; that an observer's states follow its errors, on theirs.
  double anywhere = std::max(1.0, dispersion_of_alike(location.axes));
  for (std::size_t i = 0; i < axes.size(); ++i)
    anywhere = std::max(anywhere, beyond_chance(location.axes[i], coloured[i]));
  for (AxisMap& map : location.axes) {
    const double beyond = std::max(anywhere, beyond_chance(map, map.alike_gain));
    map.bar = map.mean() + beyond * (map.bar - map.mean());
    for (double& band : map.band_m_per_s2) band *= std::sqrt(beyond);
    location.beyond_chance = std::max(location.beyond_chance, beyond);
  }

  double power = 0;
  for (const Observation& o : here.seen) {
    for (const double d : o.disturbance_m_per_s2) power += d * d;
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    AxisMap& map = location.axes[i];
    double explained = 0;
    for (std::size_t n = 0; n < here.seen.size(); ++n) {
      for (const int b : axes[i].bin[n]) {
        if (b < 0) continue;
        const double push = map.push_m_per_s2[static_cast<std::size_t>(b)];
        explained += push * push;
      }
    }
    map.share = power > 0 && !map.flat() ? std::min(1.0, explained / power) : 0;
  }
  location.over_way = spatial_frequency_profile(session, fit, options, threads);
  location.over_frequency = frequency_profile(session, fit, alike.error_m);
  location.over_lag = input_lag_profile(session, fit);
  compare_repeats(session, fit, location);
  return location;
}

}  // namespace cartwright
