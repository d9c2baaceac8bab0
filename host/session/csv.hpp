#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

/// A table of numbers with named columns; an empty cell is NaN.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< one vector per name, all of the same length
  /// Columns that hold something else than numbers (notes, states, dates) are left out: name and, in one
  /// line, what the first such cell is.
  std::map<std::string, std::string, std::less<>> texts = {};

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  const std::vector<double>* find(std::string_view name) const;
  /// A column that is needed, or why there is none.
  Result<const std::vector<double>*> required(std::string_view name, std::string_view source,
                                              std::string_view what = "column") const;
};

/// Reads CSV text. Tolerant: byte-order mark, CRLF, blank lines, spaces and quotes around cells, a semicolon
/// or tab as separator, and then a decimal comma. Strict: a header line, unique names, the same number of
/// cells in every row. `source` names the file in messages.
Result<CsvTable> parse_csv(std::string_view text, std::string_view source);
Result<CsvTable> read_csv(const std::filesystem::path& file);

/// Names as valid and unique identifiers: other characters become underscores, a second like name gets a
/// number.
std::vector<std::string> csv_identifiers(std::vector<std::string> names);

/// Header in line 1, comma and point, shortest round-trip numbers, empty cell for NaN, LF.
std::string to_csv(const CsvTable& table);

}  // namespace cartwright
