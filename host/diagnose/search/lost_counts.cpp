#include "host/diagnose/search/lost_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/statistics/distributions.hpp"

namespace cartwright {

namespace {

using P = Parameter;

/// Time during which a cart is at least as fast as that.
double time_at_speed_s(const Session& session, double speed_m_per_s) {
  constexpr std::size_t kRows = 10;
  double out = 0;
  for (const Recording& r : session.recordings) {
    for (std::size_t k = kRows; k < r.size(); ++k) {
      const double speed = std::abs(r.y_m[k] - r.y_m[k - kRows]) / (r.t_s[k] - r.t_s[k - kRows]);
      if (speed >= speed_m_per_s) out += r.t_s[k] - r.t_s[k - 1];
    }
  }
  return out;
}

/// Probability that a Poisson variable reaches `least`.
double chance_of_as_many(double mean, int least) {
  double fewer = 0, term = std::exp(-mean);
  for (int i = 0; i < least; ++i) {
    fewer += term;
    term *= mean / (i + 1);
  }
  return 1 - fewer;
}

/// Whether steps follow each other more closely than at a rate, while at least as fast as at the slowest.
bool crowded(const Session& session, std::vector<ReadingJump> jumps) {
  constexpr double kOneBurst_s = 0.01, kCrowd_s = 0.05, kLeastChance = 1e-3;
  std::sort(jumps.begin(), jumps.end(), [](const ReadingJump& a, const ReadingJump& b) {
    return std::pair(a.recording, a.row) < std::pair(b.recording, b.row);
  });
  const auto time_s = [&](const ReadingJump& jump) {
    return session.recordings[jump.recording].t_s[jump.row];
  };
  double slowest = std::numeric_limits<double>::infinity();
  int bursts = 0, close = 0;
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    slowest = std::min(slowest, std::abs(velocity_at(session.recordings[jumps[i].recording], jumps[i].row)));
    const bool first = i == 0 || jumps[i].recording != jumps[i - 1].recording;
    const double since_s =
        first ? std::numeric_limits<double>::infinity() : time_s(jumps[i]) - time_s(jumps[i - 1]);
    if (since_s > kOneBurst_s) ++bursts;
    if (since_s > kOneBurst_s && since_s <= kCrowd_s) ++close;
  }
  const double rate = bursts / std::max(time_at_speed_s(session, slowest), kCrowd_s);
  return chance_of_as_many(bursts * rate * kCrowd_s, close) < kLeastChance;
}

}  // namespace

bool like_lost_counts(const Session& session, const std::vector<ReadingJump>& jumps) {
  constexpr std::size_t kLeastJumps = 3;
  constexpr double kMostWithTheMotion = 0.2;
  if (jumps.size() < kLeastJumps) return false;
  const Session repaired = without_jumps(session, jumps);
  double with = 0;
  for (const ReadingJump& jump : jumps) {
    if (velocity_at(repaired.recordings[jump.recording], jump.row) * jump.step_m >= 0) ++with;
  }
  return with <= kMostWithTheMotion * static_cast<double>(jumps.size()) && !crowded(repaired, jumps);
}

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
  const double fast_s = time_at_speed_s(session, slowest);
  const double rate = fast_s > 0 ? n / fast_s : 0, rate_spread = fast_s > 0 ? std::sqrt(n) / fast_s : 0;
  model.set(P::missed_burst, mean).set(P::missed_rate, rate).set(P::missed_speed, slowest);
  return {
      {P::missed_burst, {mean, mean - normal_95 * spread, mean + normal_95 * spread}},
      {P::missed_rate, {rate, std::max(0.0, rate - normal_95 * rate_spread), rate + normal_95 * rate_spread}},
      // The threshold lies below the slowest burst, by about the spacing of the slow ones.
      {P::missed_speed, {slowest, std::max(0.0, slowest - 3 * (second - slowest) - 0.1 * slowest), slowest}}};
}

}  // namespace cartwright
