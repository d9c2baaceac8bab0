#pragma once

#include <filesystem>

#include "common/result.hpp"
#include "firmware/controller.hpp"
#include "firmware/rig_file.hpp"

namespace cartwright::firmware {

/// Writes the recordings of the log as a session: a CSV each and session.toml. Columns without a single
/// number are left out. Fails, writing nothing, where rows of a recording have been overwritten.
Result<void> write_session(const RigFile& rig, const Exchange& exchange,
                           const std::filesystem::path& directory);

}  // namespace cartwright::firmware
