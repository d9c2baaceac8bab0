#include "host/diagnose/confidence.hpp"

#include <algorithm>
#include <cmath>

#include "host/diagnose/explain.hpp"

namespace cartwright {
namespace {

// Set on 92 names that the diagnosis gave to sessions drawn for this alone (tests/blind, draws from 101 on:
// all effects at a third of small and small with all ten recordings, at a third of small with four, physics
// without a name). Two were wrong. The likelihood of right and wrong is flat in the temperature from 0.5
// to 1.5 nats and falls beyond; of 23 names with a rival within 20 nats one was wrong, where 1.5 nats
// expect 2.1.
constexpr double kTemperature_nats = 1.5;
/// Of 78 names with next to nothing against them one was wrong: by Laplace's rule of succession the next is
/// right with (77 + 1) / (78 + 2).
constexpr double kMost = (77.0 + 1) / (78 + 2);
/// An effect at the threshold is doubtful, one of ten times that is not.
constexpr double kGainScale_nats = 2 * kLeastGain;
constexpr double kAtBound = 0.9;

}  // namespace

double weight_of_rival(double behind_nats) {
  return std::exp(-std::max(behind_nats, 0.0) / kTemperature_nats);
}

double confidence(const Evidence& e) {
  const double real = 1 - std::exp(-std::max(e.gain_nats, 0.0) / kGainScale_nats);
  const double left = std::clamp(e.share_left, 0.0, 1.0);
  return kMost * real * (1 - left) / (1 + e.rivals) * (e.at_bound > 0 ? kAtBound : 1);
}

}  // namespace cartwright
