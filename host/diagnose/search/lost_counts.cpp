#include "host/diagnose/search/lost_counts.hpp"

#include <algorithm>
#include <cmath>

#include "host/statistics/distributions.hpp"

namespace cartwright {

namespace {

using P = Parameter;

}  // namespace

std::vector<std::pair<Parameter, Estimate>> lost_counts(const Session& session,
                                                        const std::vector<ReadingJump>& jumps, Model& model) {
  const double normal_95 = normal(0.95);
  const double count = session.rig.encoder_resolution_m;
  const double n = static_cast<double>(jumps.size());
  double sum = 0, squares = 0, slowest = 1e9, second = 1e9;
  for (const ReadingJump& jump : jumps) {
    const double size = std::abs(jump.step_m) / count;
    sum += size, squares += size * size;
    const double speed = std::abs(velocity_at(session.recordings[jump.recording], jump.row));
    if (speed < slowest)
      second = slowest, slowest = speed;
    else
      second = std::min(second, speed);
  }
  const double mean = sum / n,
               spread = n > 1 ? std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)) : mean;
  double fast_s = 0;
  for (const Recording& r : session.recordings) {
    for (std::size_t k = 10; k < r.size(); ++k) {
      const double speed = std::abs(r.y_m[k] - r.y_m[k - 10]) / (r.t_s[k] - r.t_s[k - 10]);
      if (speed >= slowest) fast_s += r.t_s[k] - r.t_s[k - 1];
    }
  }
  const double rate = fast_s > 0 ? n / fast_s : 0, rate_spread = fast_s > 0 ? std::sqrt(n) / fast_s : 0;
  model.set(P::missed_burst, mean).set(P::missed_rate, rate).set(P::missed_speed, slowest);
  return {
      {P::missed_burst, {mean, mean - normal_95 * spread, mean + normal_95 * spread}},
      {P::missed_rate, {rate, std::max(0.0, rate - normal_95 * rate_spread), rate + normal_95 * rate_spread}},
      // The threshold lies below the slowest burst, by about the spacing of the slow ones.
      {P::missed_speed, {slowest, std::max(0.0, slowest - 3 * (second - slowest) - 0.1 * slowest), slowest}}};
}

}  // namespace cartwright
