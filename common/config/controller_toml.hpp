#pragma once

#include <string>

#include "common/config/rig.hpp"
#include "common/config/toml_reader.hpp"

namespace cartwright {

/// `[rig]`: its numbers, checked. An absent table is an error.
Result<Rig> rig_from_toml(const TomlReader& root);
std::string rig_to_toml(const Rig& rig);

/// `controller = { type = "pd" | "pid" | "dual_relay", ... }` of a recording; none where there is no such
/// key.
Result<ControllerSpec> controller_from_toml(const TomlReader& entry);
std::string controller_to_toml(const ControllerSpec& controller);

}  // namespace cartwright
