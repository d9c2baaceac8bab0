#pragma once

#include <filesystem>

#include "common/config/toml_reader.hpp"
#include "firmware/settings.hpp"

namespace cartwright::firmware {

/// Reads `[compensation]` of a rig file into the registers: mode = "off" | "feedforward" | "adaptive", model
/// = "FILE", and every adaptive_* and compensation_* register by its name.
Result<void> read_compensation(Settings& out, const TomlReader& root, const std::filesystem::path& directory);

}  // namespace cartwright::firmware
