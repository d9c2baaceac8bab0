#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "host/session/mat_file.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One line of `[channels]`: column = scale * channel + offset.
struct ChannelMap {
  std::string column;
  MatSelection from;  ///< for a CSV file only the name counts
  double scale = 1, offset = 0;
};

/// How a foreign file becomes a recording.
struct ImportMap {
  std::string source;  ///< the map's file, for messages
  std::vector<ChannelMap> channels;
  Rig rig;
  bool rate_given = false, limit_given = false, travel_given = false;
  ControllerSpec controller;
  std::string experiment;
};

/// Reads a map:
///
///     [channels]
///     t_s = "t"                                              # may be absent where sample_rate_hz is given
///     y_m = { channel = "qm", scale = 1.0, offset = 0.0 }
///     u_V = { channel = "data", row = 3 }                    # or column = N; cell = [row, column]
///     [rig]                                                  # as in session.toml; every key optional here
///     [controller]                                           # as in session.toml; optional
///     [recording]
///     experiment = "track"                                   # optional
Result<ImportMap> read_import_map(const std::filesystem::path& file);

/// Reads one file through the map and checks that the numbers can be what the map says they are.
Result<Recording> import_recording(const std::filesystem::path& file, const ImportMap& map);

/// Reads several files through one map into a session, a recording `STEM.csv` each. What the rig leaves out
/// comes from the data: the sample rate from time, the travel from the positions, the voltage limit from the
/// voltages.
Result<Session> import_session(std::span<const std::filesystem::path> files, const ImportMap& map);

}  // namespace cartwright
