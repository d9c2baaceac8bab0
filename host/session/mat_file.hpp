#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

/// Which numbers of a variable: `field.field` into structures is part of the name; a cell of a cell array,
/// and a row or a column of a matrix, are counted from 1 as MATLAB does.
struct MatSelection {
  std::string variable;
  std::optional<std::pair<std::size_t, std::size_t>> cell;
  std::optional<std::size_t> row, column;
};

/// Reads vectors out of a MATLAB file, version 4, 5 or 7.3.
class MatFile {
 public:
  static Result<MatFile> open(const std::filesystem::path& file);

  /// The selected numbers as double. Fails on what is not a vector of real numbers, saying what is there
  /// instead.
  Result<std::vector<double>> read(const MatSelection& selection) const;

  std::vector<std::string> names() const;

 private:
  struct Handle;
  explicit MatFile(std::shared_ptr<Handle> handle, std::string source)
      : handle_(std::move(handle)), source_(std::move(source)) {}
  std::shared_ptr<Handle> handle_;
  std::string source_;
};

}  // namespace cartwright
