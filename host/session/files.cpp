#include "host/session/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/config/model_toml.hpp"

namespace cartwright {

Result<std::string> read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    return failure(fmt::format("{}: is a directory, a file is needed", file.string()));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) return failure(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) return failure(fmt::format("{}: reading stopped half way", file.string()));
  return std::move(text).str();
}

Result<void> write_file(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path beside = file.string() + fmt::format(".part{}", ::getpid());
  const auto give_up = [&](std::string_view doing) {
    const int reason = errno;
    std::remove(beside.c_str());
    return failure(fmt::format("{}: cannot {}: {}; nothing was written", file.string(), doing, std::strerror(reason)));
  };
  std::FILE* out = std::fopen(beside.c_str(), "wb");
  if (!out) return give_up("be written");
  const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size() && std::fflush(out) == 0 &&
                       ::fsync(::fileno(out)) == 0;
  if (std::fclose(out) != 0 || !written) return give_up("be written");
  if (std::rename(beside.c_str(), file.c_str()) != 0) return give_up("be put in place");
  return {};
}

Result<void> make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return failure(fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  return {};
}

Result<Model> read_model(const std::filesystem::path& file) {
  return read_file(file).and_then([&](const std::string& text) { return model_from_toml(text, file.string()); });
}

Result<void> write_model(const Model& model, const std::filesystem::path& file) {
  return write_file(file, to_toml(model));
}

}  // namespace cartwright
