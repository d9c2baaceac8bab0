#pragma once

#include <string>

#include "host/cli/device_command.hpp"
#include "host/device/download.hpp"

namespace cartwright::cli {

/// Fetches recordings and writes them as a session; says what was lost.
Outcome pull_into(device::Controller& controller, device::Range range, const std::string& directory);

}  // namespace cartwright::cli
