#include "host/session/files.hpp"

#include "common/config/model_toml.hpp"

namespace cartwright {

Result<Model> read_model(const std::filesystem::path& file) {
  return read_file(file).and_then(
      [&](const std::string& text) { return model_from_toml(text, file.string()); });
}

Result<void> write_model(const Model& model, const std::filesystem::path& file,
                         const std::vector<ParameterInterval>& intervals) {
  return write_file(file, to_toml(model) + intervals_to_toml(intervals));
}

Result<ModelWithIntervals> read_model_with_intervals(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto model = model_from_toml(*text, file.string());
  if (!model) return tl::unexpected(model.error());
  const auto intervals = intervals_from_toml(*text, file.string(), *model);
  if (!intervals) return tl::unexpected(intervals.error());
  return ModelWithIntervals{*model, *intervals};
}

}  // namespace cartwright
