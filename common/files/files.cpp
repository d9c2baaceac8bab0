#include "common/files/files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

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

namespace {

/// What a rename must replace: the file a link leads to, not the link.
std::filesystem::path behind_links(const std::filesystem::path& file) {
  std::error_code dangling;
  const std::filesystem::path target = std::filesystem::canonical(file, dangling);
  return dangling ? file : target;
}

std::filesystem::path part_of(const std::filesystem::path& file) {
  return behind_links(file).string() + fmt::format(".part{}", ::getpid());
}

/// A device or a pipe, such as /dev/stdout: written to, never replaced.
bool is_special(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

Result<void> write_special(const std::filesystem::path& file, std::string_view text) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  const bool written = out && std::fwrite(text.data(), 1, text.size(), out) == text.size();
  const bool closed = out && std::fclose(out) == 0;
  if (written && closed) return {};
  return failure(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
}

/// Writes the text to the file's `.part`, which is gone again if that fails.
Result<void> write_part(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path part = part_of(file);
  const auto give_up = [&] {
    const int reason = errno;
    std::remove(part.c_str());
    return failure(
        fmt::format("{}: cannot be written: {}; nothing was written", file.string(), std::strerror(reason)));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    errno = EISDIR;
    return give_up();
  }
  if (is_special(file)) return failure(fmt::format("{}: is no file; nothing was written", file.string()));
  std::FILE* out = std::fopen(part.c_str(), "wb");
  if (!out) return give_up();
  const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size() &&
                       std::fflush(out) == 0 && ::fsync(::fileno(out)) == 0;
  if (std::fclose(out) != 0 || !written) return give_up();
  return {};
}

Result<void> put_in_place(const std::filesystem::path& file) {
  if (std::rename(part_of(file).c_str(), behind_links(file).c_str()) == 0) return {};
  const int reason = errno;
  std::remove(part_of(file).c_str());
  return failure(fmt::format("{}: cannot be put in place: {}", file.string(), std::strerror(reason)));
}

}  // namespace

Result<void> write_file(const std::filesystem::path& file, std::string_view text) {
  if (is_special(file)) return write_special(file, text);
  const auto written = write_part(file, text);
  return written ? put_in_place(file) : written;
}

Result<void> write_files(const std::filesystem::path& directory, const std::vector<NamedText>& files) {
  // The outermost directory that is not there yet: what to take away again.
  std::filesystem::path made_here;
  std::error_code ignored;
  for (std::filesystem::path level = std::filesystem::absolute(directory, ignored);
       !level.empty() && !std::filesystem::exists(level, ignored); level = level.parent_path()) {
    made_here = level;
  }
  Result<void> outcome = make_directory(directory);
  for (std::size_t i = 0; i < files.size() && outcome; ++i) {
    outcome = write_part(directory / files[i].name, files[i].text);
  }
  if (!outcome) {
    for (const NamedText& file : files) std::remove(part_of(directory / file.name).c_str());
    if (!made_here.empty()) std::filesystem::remove_all(made_here, ignored);
    return outcome;
  }
  for (const NamedText& file : files) {
    const auto placed = put_in_place(directory / file.name);
    if (!placed && outcome) outcome = placed;
  }
  return outcome;
}

Result<void> make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) return failure(fmt::format("{}: cannot be made: {}", directory.string(), error.message()));
  return {};
}

}  // namespace cartwright
