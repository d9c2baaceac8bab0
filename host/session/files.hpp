#pragma once

#include <filesystem>

#include <vector>

#include "common/config/interval_toml.hpp"
#include "common/files/files.hpp"
#include "common/model/model.hpp"
#include "common/result.hpp"

namespace cartwright {

Result<Model> read_model(const std::filesystem::path& file);
Result<void> write_model(const Model& model, const std::filesystem::path& file,
                         const std::vector<ParameterInterval>& intervals = {});

/// A model with the 95 % intervals that its file gives.
struct ModelWithIntervals {
  Model model;
  std::vector<ParameterInterval> intervals;
};

Result<ModelWithIntervals> read_model_with_intervals(const std::filesystem::path& file);

}  // namespace cartwright
