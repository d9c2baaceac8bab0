#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "host/session/mat_file.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One channel of a foreign file.
struct ChannelSource {
  MatSelection from;  ///< for CSV and JSON files only the name counts
  std::optional<unsigned>
      signed_bits;          ///< a two's complement number of so many bits that was stored unsigned
  bool every_cell = false;  ///< `cell_row`: the column comes from `cell_columns`
};

/// One line of `[channels]`: column = scale * channel [* times] + offset.
struct ChannelMap {
  std::string column;
  std::vector<ChannelSource> factors;  ///< one, or two where the line says `times`
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
  std::string rows;                       ///< of a JSON file: the array of objects that holds the rows
  std::optional<double> resample_hz;      ///< see even_rows.hpp
  std::vector<std::size_t> cell_columns;  ///< a recording each
};

/// Reads a map:
///
///     [channels]
///     t_s = "t"                                              # may be absent where sample_rate_hz is given
///     y_m = { channel = "qm", scale = 1.0, offset = 0.0 }
///     u_V = { channel = "data", row = 3 }                    # or column = N; cell = [row, column]
///     u_V = { channel = "load", signed_bits = 16, times = "supply", scale = 1.13e-3 }    # duty times supply
///     [rig]                                                  # as in session.toml; every key optional here
///     [controller]                                           # as in session.toml; optional
///     [recording]
///     experiment = "track"                                   # every key optional
///     rows = "entries"                                       # JSON: the array that holds the rows
///     resample_hz = 400                                      # rows put onto an even grid
///     cell_columns = [2, 4, 6]                               # a recording of each, for channels with
///     cell_row
Result<ImportMap> read_import_map(const std::filesystem::path& file);

/// Reads one file through the map and checks that the numbers can be what the map says they are. With
/// `cell_column` it takes that column of the cells.
Result<Recording> import_recording(const std::filesystem::path& file, const ImportMap& map,
                                   std::optional<std::size_t> cell_column = std::nullopt);

/// Reads several files through one map into a session, a recording `STEM.csv` each (`STEM_COLUMN.csv` for
/// each of `cell_columns`). What the rig leaves out comes from the data: the sample rate from time, the
/// travel from the positions, the voltage limit from the voltages.
Result<Session> import_session(std::span<const std::filesystem::path> files, const ImportMap& map);

}  // namespace cartwright
