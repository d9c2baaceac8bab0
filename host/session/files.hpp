#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/model/model.hpp"
#include "common/result.hpp"

namespace cartwright {

Result<std::string> read_file(const std::filesystem::path& file);

/// Writes beside the file and renames over it: the file is whole or untouched, also on a full disk.
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

Result<void> make_directory(const std::filesystem::path& directory);

Result<Model> read_model(const std::filesystem::path& file);
Result<void> write_model(const Model& model, const std::filesystem::path& file);

}  // namespace cartwright
