#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

/// A table of numbers with named columns; an empty cell is NaN.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< one vector per name, all of the same length

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  const std::vector<double>* find(std::string_view name) const;
};

/// Reads CSV text. Tolerant: byte-order mark, CRLF, blank lines, spaces and quotes around cells, a semicolon
/// or tab as separator, and then a decimal comma. Strict: a header line, unique names, numbers only, the same
/// number of cells in every row. `source` names the file in messages.
Result<CsvTable> parse_csv(std::string_view text, std::string_view source);
Result<CsvTable> read_csv(const std::filesystem::path& file);

/// Names as valid and unique identifiers: other characters become underscores, a second like name gets a
/// number.
std::vector<std::string> csv_identifiers(std::vector<std::string> names);

/// Header in line 1, comma and point, shortest round-trip numbers, empty cell for NaN, LF.
std::string to_csv(const CsvTable& table);

}  // namespace cartwright
