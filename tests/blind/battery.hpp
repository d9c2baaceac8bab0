#pragma once

#include <cstdint>

#include "host/session/session.hpp"
#include "tests/blind/cart.hpp"

namespace cartwright::blind {

/// Ten recordings, 68 s: three repeats of a step, another step, two relays, two tracks, a slow sweep and a
/// dither, at the given rate with ticks that start a little late, and now and then later.
Session battery(const CartPhysics& cart, std::uint64_t seed, double sample_rate_hz = 1000);

/// One more track on the same cart, which nobody is to fit.
Session unseen_track(const CartPhysics& cart, std::uint64_t seed, double sample_rate_hz = 1000);

}  // namespace cartwright::blind
