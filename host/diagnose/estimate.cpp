#include "host/diagnose/estimate.hpp"

#include <algorithm>

#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Readings of the cart tell gap (1 - share), friction_share/share and damping_share/share (scan_gaps.cpp)
/// and hardly the share of the mass itself, so the intervals hold every share that machines usually have.
constexpr double kUsualShare[] = {0.3, 0.7};

double with_share(const Model& model, Parameter id, double share) {
  const double found = model[P::backlash_load_share];
  if (id == P::backlash_gap) return model[id] * (1 - found) / (1 - share);
  return model[id] * share / found;
}

}  // namespace

Estimate estimate(const Fit& fit, Parameter id) {
  const double half = normal(0.95) * fit.standard_error(id);
  const ParameterInfo& range = info(id);
  const double value = fit.model[id];
  double low = value - half, high = value + half;
  if (id == P::backlash_gap || id == P::backlash_load_share || id == P::backlash_load_friction_share ||
      id == P::backlash_load_damping_share) {
    low = std::min(low, with_share(fit.model, id, kUsualShare[0]));
    high = std::max(high, with_share(fit.model, id, kUsualShare[1]));
  }
  return {value, std::max(low, range.lower), std::min(high, range.upper)};
}

}  // namespace cartwright
