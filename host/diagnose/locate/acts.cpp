#include "host/diagnose/locate/acts.hpp"

#include <algorithm>
#include <bit>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <utility>

namespace cartwright {
namespace {

constexpr std::size_t kFineBins = 60;
constexpr double kMuch = 2;            // times the mean power
constexpr double kGoodPart = 1.0 / 4;  // of all power: less is where the cart happened to be
constexpr double kLowShare = 0.1, kHighShare = 0.9;

/// The stretch that holds most power beyond `kMuch` times the mean.
std::vector<double> strongest_stretch(const AxisBins& axis, const std::vector<std::vector<double>>& push) {
  if (axis.edges.size() < 2) return {};
  std::vector<double> power(axis.edges.size() - 1), rows(power.size());
  double all_power = 0, all_rows = 0;
  for (std::size_t n = 0; n < push.size(); ++n) {
    for (std::size_t k = 0; k < push[n].size(); ++k) {
      if (axis.bin[n][k] < 0) continue;
      const auto bin = static_cast<std::size_t>(axis.bin[n][k]);
      const double p = push[n][k] * push[n][k];
      power[bin] += p, rows[bin] += 1, all_power += p, all_rows += 1;
    }
  }
  std::vector<double> best;
  double most = 0, best_part = 0, excess = 0, part = 0;
  std::size_t from = 0;
  for (std::size_t b = 0; b < power.size() && all_power > 0; ++b) {
    if (excess <= 0) from = b, excess = part = 0;
    part += power[b] / all_power;
    excess += power[b] / all_power - kMuch * rows[b] / all_rows;
    if (excess > most) most = excess, best_part = part, best = {axis.edges[from], axis.edges[b + 1]};
  }
  return best_part > kGoodPart ? best : std::vector<double>{};
}

/// The band that holds the middle of the power.
std::vector<double> band(const Rig& rig, const std::vector<std::vector<double>>& push) {
  std::vector<std::pair<double, double>> power;  // at a frequency
  double all = 0;
  for (std::vector<double> one : push) {
    if (one.size() < 2) continue;
    one.resize(std::bit_ceil(one.size()));  // of a length that is prime the transform takes a square of it
    std::vector<std::complex<double>> spectrum;
    Eigen::FFT<double>().fwd(spectrum, one);
    const auto rows = static_cast<double>(one.size());
    for (std::size_t i = 0; i <= one.size() / 2; ++i) {
      const double sides = i == 0 || 2 * i == one.size() ? 1 : 2;
      power.emplace_back(static_cast<double>(i) * rig.sample_rate_hz / rows,
                         sides * std::norm(spectrum[i]) / rows);
      all += power.back().second;
    }
  }
  std::sort(power.begin(), power.end());
  std::vector<double> edges;
  double below = 0;
  for (const auto& [at_hz, here] : power) {
    below += here;
    if (edges.empty() && below >= kLowShare * all) edges.push_back(at_hz);
    if (below >= kHighShare * all) {
      edges.push_back(at_hz);
      break;
    }
  }
  return all > 0 ? edges : std::vector<double>{};
}

}  // namespace

Acts::Acts(const Session& session, const Fit& fit, const FitOptions& options)
    : session_(session),
      fit_(fit),
      threads_(options.threads),
      gains_(observer_gains(fit.noise, session.rig.period_s(), options.damping_per_s)),
      with_(seen_by(fit.model)),
      axes_(axes_of(session, with_, kFineBins)) {}

std::vector<Observation> Acts::seen_by(const Model& model) const {
  ObserverOptions keep;
  keep.keep_states = true;
  return observe(model, gains_, session_, keep, threads_);
}

Where Acts::where(Term effect) const {
  Where where = nowhere();
  if (effect == Term::encoder_eccentricity || effect == Term::encoder_missed_counts) return where;
  Model without_it = fit_.model;
  without_it.remove(effect);
  const std::vector<Observation> without = seen_by(without_it);
  std::vector<std::vector<double>> push(with_.size());
  for (std::size_t n = 0; n < push.size(); ++n) {
    for (std::size_t k = 0; k < session_.recordings[n].size(); ++k) {
      // What an observer adds by itself is no part of its model.
      const auto own = [k](const Observation& seen) {
        return seen.acceleration_m_per_s2[k] - seen.disturbance_m_per_s2[k];
      };
      push[n].push_back(k < settling_rows(session_.rig) ? 0 : own(with_[n]) - own(without[n]));
    }
  }
  for (const AxisBins& axis : axes_) {
    if (where.contains(axis.axis)) where[axis.axis] = strongest_stretch(axis, push);
  }
  where["frequency_hz"] = band(session_.rig, push);
  if (effect == Term::external_disturbance) {
    const double start_s = fit_.model[Parameter::disturbance_start];
    where["time_s"] = {start_s, start_s + fit_.model[Parameter::disturbance_duration]};
  }
  return where;
}

}  // namespace cartwright
