#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

Result<std::string> read_file(const std::filesystem::path& file);

/// Writes beside the file and renames over it: the file is whole or untouched, also on a full disk. A link
/// stays one, the file it leads to is replaced; a device or a pipe is written to as it is.
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

struct NamedText {
  std::string name;  ///< of a file in the directory
  std::string text;
};

/// Writes several files into a directory, made if it is not there: first all beside their places, then all
/// renamed. On a failure before the renaming nothing changes, and a directory made for them is gone again.
Result<void> write_files(const std::filesystem::path& directory, const std::vector<NamedText>& files);

Result<void> make_directory(const std::filesystem::path& directory);

}  // namespace cartwright
