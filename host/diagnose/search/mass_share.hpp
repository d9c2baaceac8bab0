#pragma once

#include "common/model/model.hpp"

namespace cartwright {

/// The same motion of a cart with backlash, with another share of the mass on the cart's side of the gap.
/// While the teeth are apart the cart shows its friction and damping over its mass; when they meet, it shows
/// the motor's momentum, (1 - share) times the speed that the gap let it gather. So readings of the cart tell
/// gap (1 - share), friction_share/share and damping_share/share, and little more.
Model with_share(Model model, double share);

}  // namespace cartwright
