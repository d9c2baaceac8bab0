#include "host/diagnose/search/some_recordings.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace cartwright {
namespace {

constexpr double kFastestReversals_per_s = 12;

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

std::vector<const Recording*> without_repeats(const Session& session) {
  std::vector<const Recording*> out;
  for (const Recording& r : session.recordings) {
    if (r.repeat_of.empty()) out.push_back(&r);
  }
  return out;
}

Session first_of(const std::vector<const Recording*>& order, const Rig& rig, double most_s) {
  Session some;
  some.rig = rig;
  double length_s = 0;
  for (const Recording* r : order) {
    some.recordings.push_back(*r);
    length_s += r->t_s.back() - r->t_s.front();
    if (length_s >= most_s) break;
  }
  return some;
}

}  // namespace

Session most_reversals(const Session& session, double most_s) {
  std::vector<const Recording*> order = without_repeats(session);
  std::stable_sort(order.begin(), order.end(), [&](const Recording* a, const Recording* b) {
    const double of_a = reversals_per_s(*a, session.rig), of_b = reversals_per_s(*b, session.rig);
    const bool crowded_a = of_a > kFastestReversals_per_s, crowded_b = of_b > kFastestReversals_per_s;
    return crowded_a != crowded_b ? crowded_b : of_a > of_b;
  });
  return first_of(order, session.rig, most_s);
}

Session one_of_each_kind(const Session& session, double most_s) {
  std::vector<const Recording*> order, further;
  std::set<std::string> kinds;
  for (const Recording* r : without_repeats(session)) {
    (kinds.insert(r->experiment).second ? order : further).push_back(r);
  }
  order.insert(order.end(), further.begin(), further.end());
  return first_of(order, session.rig, most_s);
}

}  // namespace cartwright
