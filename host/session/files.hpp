#pragma once

#include <filesystem>

#include "common/files/files.hpp"
#include "common/model/model.hpp"
#include "common/result.hpp"

namespace cartwright {

Result<Model> read_model(const std::filesystem::path& file);
Result<void> write_model(const Model& model, const std::filesystem::path& file);

}  // namespace cartwright
