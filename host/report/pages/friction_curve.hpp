#pragma once

#include <vector>

#include "host/report/pages/named_model.hpp"

namespace cartwright::report {

/// What opposes steady motion against speed, in both directions: damping and friction of each model less its
/// constant push [m/s^2]. Two models with different words for the same cart lie on one curve where they
/// agree.
Plot friction_curves(const std::vector<NamedModel>& models, double greatest_speed_m_per_s);

}  // namespace cartwright::report
