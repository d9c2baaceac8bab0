#include "host/diagnose/judge/told_apart.hpp"

namespace cartwright {
namespace {

constexpr double kChance_z = 2.5;
constexpr double kChance_nats = 10;

/// How sure one explanation is to be better than another.
double paired_z(const Fit& better, const Fit& worse) {
  const PairedDifference d = paired_difference(better, worse);
  return d.spread > 0 ? d.nats / d.spread : 0;
}

}  // namespace

bool told_apart(const Contest& contest, const Explanation& other, double nats_left, double least_gain) {
  const double behind = contest.winner.score() - other.score();
  if (behind < kChance_nats && paired_z(contest.winner.fit, other.fit) < kChance_z) return false;
  return behind >= nats_left || other.score() - contest.without < least_gain;
}

}  // namespace cartwright
