#include <algorithm>

#include "host/diagnose/scan.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kRatioOfGaps = 1.2;
constexpr double kMostData_s = 30;
constexpr std::size_t kStartsKept = 2;

/// A share of the session that shows what a gap does: no repeats, the longest way first.
Session without_repeats(const Session& session) {
  std::vector<std::size_t> order;
  std::vector<double> way(session.recordings.size());
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    const Recording& r = session.recordings[n];
    if (!r.repeat_of.empty()) continue;
    for (std::size_t k = 1; k < r.size(); ++k) way[n] += std::abs(r.y_m[k] - r.y_m[k - 1]);
    order.push_back(n);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return way[a] > way[b]; });
  Session some;
  some.rig = session.rig;
  double length_s = 0;
  for (const std::size_t n : order) {
    if (length_s >= kMostData_s) break;
    some.recordings.push_back(session.recordings[n]);
    length_s += session.recordings[n].t_s.back() - session.recordings[n].t_s.front();
  }
  return some;
}

}  // namespace

std::vector<Promise> scan_gaps(const Session& session, const Fit& base, const Promise& from,
                               const SessionFacts& facts, const FitOptions& options, unsigned threads) {
  const double count = facts.count_m > 0 ? facts.count_m : 1e-4 * facts.travel_m();
  std::vector<Promise> starts;
  for (const double share : {0.35, 0.5, 0.65}) {
    for (const double friction_share : {0.4, 0.75}) {
      for (double gap = 2 * count; gap < 0.03 * facts.travel_m(); gap *= kRatioOfGaps) {
        Promise one = from;
        one.start.set(P::backlash_gap, gap)
            .set(P::backlash_load_share, share)
            .set(P::backlash_load_friction_share, friction_share)
            .set(P::backlash_load_damping_share, 0.25)
            .set(P::backlash_contact_resonance, 250)
            .set(P::backlash_contact_damping_ratio, 0.2);
        starts.push_back(std::move(one));
      }
    }
  }
  const Session some = without_repeats(session);
  const double without =
      log_likelihood(counted_errors(some, base.model, base.noise, options), options.outlier_m);
  parallel_for(starts.size(), threads, [&](std::size_t i) {
    const std::vector<double> errors = counted_errors(some, starts[i].start, base.noise, options);
    starts[i].log_likelihood_gain = log_likelihood(errors, options.outlier_m) - without;
  });
  std::stable_sort(starts.begin(), starts.end(), [](const Promise& a, const Promise& b) {
    return a.log_likelihood_gain > b.log_likelihood_gain;
  });
  if (starts.size() > kStartsKept) starts.resize(kStartsKept);
  return starts;
}

}  // namespace cartwright
