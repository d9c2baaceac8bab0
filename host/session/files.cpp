#include "host/session/files.hpp"

#include "common/config/model_toml.hpp"

namespace cartwright {

Result<Model> read_model(const std::filesystem::path& file) {
  return read_file(file).and_then(
      [&](const std::string& text) { return model_from_toml(text, file.string()); });
}

Result<void> write_model(const Model& model, const std::filesystem::path& file) {
  return write_file(file, to_toml(model));
}

}  // namespace cartwright
