#include "host/diagnose/evolve_gap.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "host/diagnose/evolution.hpp"
#include "host/diagnose/mass_share.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kMostData_s = 18;
constexpr double kFastestReversals_per_s = 12;
constexpr int kMostEvaluations = 700;
/// First steps: of the mass's share along the way that it can hardly be told on, of what else the teeth have,
/// and of all other numbers as a part of themselves.
constexpr double kStepOfShare = 0.1, kStepOfTeeth = 0.05, kStepOfRest = 0.01;

/// Reversals of the velocity over 10 ms, per second.
double reversals_per_s(const Recording& r, const Rig& rig) {
  const auto span = static_cast<std::size_t>(std::max(1.0, 0.01 * rig.sample_rate_hz));
  const double least_m = 3 * rig.encoder_resolution_m;
  int reversals = 0;
  double last = 0;
  for (std::size_t k = span; k < r.size(); k += span) {
    const double moved = r.y_m[k] - r.y_m[k - span];
    if (std::abs(moved) <= least_m) continue;
    reversals += last * moved < 0;
    last = moved;
  }
  return reversals / std::max(r.t_s.back() - r.t_s.front(), rig.period_s());
}

/// So many steps away from a model, within bounds.
Model moved(const Model& from, const std::vector<FreeParameter>& free, const Eigen::VectorXd& steps) {
  Model to = from;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double by = steps[static_cast<Eigen::Index>(i)];
    if (free[i].id == P::backlash_load_share)
      to = with_share(to, std::clamp(from[free[i].id] + kStepOfShare * by, free[i].lower, free[i].upper));
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    const FreeParameter& p = free[i];
    if (p.id == P::backlash_load_share) continue;
    const double by = steps[static_cast<Eigen::Index>(i)], here = to[p.id];
    const bool teeth = info(p.id).term == Term::backlash;
    const double size = teeth ? kStepOfTeeth : kStepOfRest;
    const double scale = teeth ? 1 : std::max(std::abs(here), 0.1 * p.scale);
    const double there = p.logarithmic ? here * std::exp(size * by) : here + size * scale * by;
    to.set(p.id, std::clamp(there, p.lower, p.upper));
  }
  return to;
}

/// A share of the session with one recording of each kind before a second of any, no repeats: steps show the
/// cart fly, relay tests show it caught.
Session varied(const Session& session, double most_s) {
  std::vector<const Recording*> first, further;
  std::set<std::string> kinds;
  for (const Recording& r : session.recordings) {
    if (r.repeat_of.empty()) (kinds.insert(r.experiment).second ? first : further).push_back(&r);
  }
  first.insert(first.end(), further.begin(), further.end());
  Session some;
  some.rig = session.rig;
  double length_s = 0;
  for (const Recording* r : first) {
    some.recordings.push_back(*r);
    length_s += r->t_s.back() - r->t_s.front();
    if (length_s >= most_s) break;
  }
  return some;
}

}  // namespace

Session shows_gap(const Session& session, double most_s) {
  struct Choice {
    std::size_t recording;
    double reversals_per_s;
  };
  std::vector<Choice> order;
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    if (!session.recordings[n].repeat_of.empty()) continue;
    order.push_back({n, reversals_per_s(session.recordings[n], session.rig)});
  }
  const auto crowded = [](const Choice& c) { return c.reversals_per_s > kFastestReversals_per_s; };
  std::stable_sort(order.begin(), order.end(), [&](const Choice& a, const Choice& b) {
    return crowded(a) != crowded(b) ? crowded(b) : a.reversals_per_s > b.reversals_per_s;
  });
  Session some;
  some.rig = session.rig;
  double length_s = 0;
  for (const Choice& choice : order) {
    const Recording& r = session.recordings[choice.recording];
    some.recordings.push_back(r);
    length_s += r.t_s.back() - r.t_s.front();
    if (length_s >= most_s) break;
  }
  return some;
}

Model evolve_gap(const Session& session, const Model& from, const NoiseModel& noise,
                 const std::vector<FreeParameter>& free, FitOptions options, unsigned threads) {
  const Session some = varied(session, kMostData_s);
  options.threads = 1;
  const auto cost = [&](const Eigen::VectorXd& steps) {
    return -log_likelihood(counted_errors(some, moved(from, free, steps), noise, options), options.outlier_m);
  };
  EvolutionOptions search;
  search.threads = threads;
  search.most_evaluations = kMostEvaluations;
  const auto numbers = static_cast<Eigen::Index>(free.size());
  return moved(from, free, evolve(cost, Eigen::VectorXd::Zero(numbers), search));
}

}  // namespace cartwright
