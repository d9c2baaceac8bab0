#include "host/diagnose/judge/estimate.hpp"

#include <algorithm>

#include "host/diagnose/search/mass_share.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Readings hardly tell the share of the mass (mass_share.hpp), so the intervals hold every share that
/// machines usually have.
constexpr double kUsualShare[] = {0.3, 0.7};

}  // namespace

Estimate estimate(const Fit& fit, Parameter id) {
  const double half = normal(0.95) * fit.standard_error(id);
  const ParameterInfo& range = info(id);
  const double value = fit.model[id];
  double low = value - half, high = value + half;
  if (id == P::backlash_gap || id == P::backlash_load_share || id == P::backlash_load_friction_share ||
      id == P::backlash_load_damping_share) {
    low = std::min(low, with_share(fit.model, kUsualShare[0])[id]);
    high = std::max(high, with_share(fit.model, kUsualShare[1])[id]);
  }
  return {value, std::max(low, range.lower), std::min(high, range.upper)};
}

Estimate estimate_of(const Model& model, const Fit& fit, Parameter id) {
  const Estimate fitted = estimate(fit, id);
  const double value = model[id];
  if (value == fitted.value) return fitted;
  const double half = std::max(value - fitted.low, fitted.high - value);
  return {value, std::max(value - half, info(id).lower), std::min(value + half, info(id).upper)};
}

}  // namespace cartwright
