#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/config/rig.hpp"
#include "common/result.hpp"
#include "host/session/csv.hpp"

namespace cartwright {

/// One recording: a row per controller tick. `y_m` was read at the row's own `t_s`; `u_V`, the command after
/// the limit, holds until the next row. Optional columns are empty where the file has none.
struct Recording {
  std::string file;
  std::string experiment;
  ControllerSpec controller;
  std::string repeat_of;

  std::vector<double> t_s, y_m, u_V;
  std::vector<double> r_m, d_V;
  std::map<std::string, std::vector<double>> other_columns;  ///< kept as read; empty cells are NaN

  std::size_t size() const { return t_s.size(); }
  bool has_controller() const { return !std::holds_alternative<std::monostate>(controller); }
  const std::string& original() const { return repeat_of.empty() ? file : repeat_of; }
  double added_V(std::size_t row) const { return d_V.empty() ? 0.0 : d_V[row]; }
};

struct Session {
  Rig rig;
  std::vector<Recording> recordings;
  /// How many recordings come without a control law.
  std::size_t without_law() const;
};

/// Moves the columns of a table into a recording and checks them: required ones there, finite, time
/// increasing.
Result<void> take_columns(Recording& recording, CsvTable table, const std::string& source);
CsvTable to_table(const Recording& recording);

/// Reads `session.toml` and every recording it names.
Result<Session> read_session(const std::filesystem::path& directory);

/// Writes `session.toml` and the recordings: all of it, or nothing and no directory.
Result<void> write_session(const Session& session, const std::filesystem::path& directory);

}  // namespace cartwright
