#pragma once

#include "common/wire/codes.hpp"

namespace cartwright::firmware {

/// What an experiment asks for at one tick.
struct Demand {
  double reference_m = 0;
  double added_V = 0;                              ///< after the control law, before the limits
  wire::Outcome outcome = wire::Outcome::running;  ///< anything else: this tick is no longer part of it
};

}  // namespace cartwright::firmware
