#include "host/diagnose/search/mass_share.hpp"

#include <algorithm>

namespace cartwright {
namespace {

using P = Parameter;

}  // namespace

Model with_share(Model model, double share) {
  const double before = model[P::backlash_load_share];
  const auto part = [&](P id) { return std::min(model[id] * share / before, 1.0); };
  const double friction = part(P::backlash_load_friction_share),
               damping = part(P::backlash_load_damping_share);
  return model.set(P::backlash_gap, model[P::backlash_gap] * (1 - before) / (1 - share))
      .set(P::backlash_load_share, share)
      .set(P::backlash_load_friction_share, friction)
      .set(P::backlash_load_damping_share, damping);
}

}  // namespace cartwright
