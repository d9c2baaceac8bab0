#pragma once

#include <filesystem>
#include <string_view>

#include "common/result.hpp"
#include "host/session/csv.hpp"

namespace cartwright {

/// Reads a log that is an array of objects, a row each, with the same keys: `[{"t": 0, "y": 1}, ...]`, or an
/// object that holds such an array under the key `rows`; where `rows` is empty, the only array of objects it
/// holds. Numbers and truth values (1 and 0) become columns named by their keys; other values do not. A row
/// that lacks a key has an empty cell (NaN) there.
Result<CsvTable> read_json_rows(const std::filesystem::path& file, std::string_view rows);

}  // namespace cartwright
