#include "host/diagnose/confidence.hpp"

#include <cmath>

#include "host/diagnose/explain.hpp"

namespace cartwright {

double confidence(const Evidence& e) {
  const double real = 1 - std::exp(-e.gain_nats / (2 * kLeastGain));
  return real * (1 - e.share_left) / (1 + e.rivals) * (e.at_bound > 0 ? 0.9 : 1);
}

}  // namespace cartwright
