#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/device/controller.hpp"

namespace cartwright::device {

/// What to write for a model: its numbers in the model_* registers, initial values where it has none.
std::vector<Setting> model_settings(const Model& model);

}  // namespace cartwright::device
