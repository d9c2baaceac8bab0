#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One number that a fit by simulation moves, and its natural size.
struct SlowParameter {
  Parameter id;
  double scale;
};

/// The numbers of a model that act on the balance of pushes over the whole way: gain, frictions, pushes,
/// spring, drag, dead zone. Their natural sizes come from what the session shows: the drive's push, the
/// speed, the way and the duration. The neutral position of a spring beside a constant force is the same
/// number twice and left out.
std::vector<SlowParameter> slow_parameters(const Session& session, const Model& model,
                                           const std::vector<Parameter>& held);

}  // namespace cartwright
