#include "host/export/matlab.hpp"

#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "host/export/controller_fields.hpp"
#include "host/export/identifier.hpp"
#include "host/session/files.hpp"
#include "host/session/gaps.hpp"

namespace cartwright {
namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// matio takes its input as void*, but without MAT_F_DONT_COPY_DATA it copies and does not write to it.
void* copied(const void* input) {
  return const_cast<void*>(input);
}

/// Column-major numbers.
Variable matrix(const std::vector<double>& values, std::size_t rows, std::size_t columns) {
  std::size_t size[] = {rows, columns};
  return Variable(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, copied(values.data()), 0));
}
Variable column(const std::vector<double>& values) {
  return matrix(values, values.size(), 1);
}
Variable number(double value) {
  return matrix({value}, 1, 1);
}

Variable text(const std::string& value) {
  std::size_t size[] = {value.empty() ? 0u : 1u, value.size()};
  return Variable(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, size, copied(value.data()), 0));
}

/// A 1x1 struct being filled; it owns its fields.
class Struct {
 public:
  explicit Struct(const std::string& name) {
    std::size_t size[] = {1, 1};
    variable_.reset(Mat_VarCreateStruct(name.c_str(), 2, size, nullptr, 0));
  }
  Struct& add(const std::string& name, Variable value) {
    Mat_VarAddStructField(variable_.get(), name.c_str());
    Mat_VarSetStructFieldByName(variable_.get(), name.c_str(), 0, value.release());
    return *this;
  }
  Variable take() { return std::move(variable_); }

 private:
  Variable variable_;
};

Variable rig_variable(const Rig& rig, const std::string& name) {
  Struct result(name);
  result.add("name", text(rig.name))
      .add("sample_rate_hz", number(rig.sample_rate_hz))
      .add("encoder_resolution_m", number(rig.encoder_resolution_m))
      .add("voltage_limit_V", number(rig.voltage_limit_V))
      .add("travel_m", matrix({rig.travel_m[0], rig.travel_m[1]}, 1, 2));
  return result.take();
}

Variable controller_variable(const ControllerSpec& controller) {
  const ControllerFields gains = controller_fields(controller);
  if (gains.type.empty()) return matrix({}, 0, 0);
  Struct result("controller");
  result.add("type", text(gains.type));
  for (std::size_t i = 0; i < gains.names.size(); ++i) result.add(gains.names[i], number(gains.values[i]));
  return result.take();
}

Variable losses_variable(const std::vector<Gap>& gaps) {
  std::vector<double> values;
  for (const Gap& gap : gaps) values.push_back(gap.from_s);
  for (const Gap& gap : gaps) values.push_back(gap.to_s);
  return matrix(values, gaps.size(), 2);
}

Variable recording_variable(const Recording& recording, const std::string& name) {
  const CsvTable table = to_table(recording);
  std::vector<std::string> names = {"file", "experiment", "repeat_of", "controller", "losses_s"};
  const std::size_t own = names.size();
  names.insert(names.end(), table.names.begin(), table.names.end());
  names = identifiers(names);
  Struct result(name);
  result.add("file", text(recording.file))
      .add("experiment", text(recording.experiment))
      .add("repeat_of", text(recording.repeat_of))
      .add("controller", controller_variable(recording.controller))
      .add("losses_s", losses_variable(find_gaps(recording.t_s)));
  for (std::size_t i = 0; i < table.columns.size(); ++i) result.add(names[own + i], column(table.columns[i]));
  return result.take();
}

/// Whether a version 5 file is whole: after the header of 128 bytes exactly `count` elements, each of which
/// begins with `uint32 type, uint32 size`. matio does not report a write that failed, so what it wrote is
/// looked at.
bool holds_elements(std::string_view bytes, std::size_t count) {
  constexpr std::size_t kHeader = 128, kTag = 8;
  std::size_t at = kHeader;
  for (; count > 0; --count) {
    if (at + kTag > bytes.size()) return false;
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + sizeof size, sizeof size);
    at += kTag + size;
  }
  return at == bytes.size();
}

/// A file in memory: matio writes only to paths and does not report a full disk, so it never sees the real
/// one.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("cartwright-mat", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

}  // namespace

Result<std::string> to_matlab(const Session& session) {
  const MemoryFile file;
  struct CloseFile {
    void operator()(mat_t* open) const { Mat_Close(open); }
  };
  std::unique_ptr<mat_t, CloseFile> out(Mat_CreateVer(
      file.path().c_str(), "MATLAB 5.0 MAT-file, written by Cartwright " CARTWRIGHT_VERSION, MAT_FT_MAT5));
  if (!out) return failure("no memory for the MATLAB file");
  std::vector<std::string> names = {"rig"};
  for (const Recording& recording : session.recordings) {
    names.push_back(std::filesystem::path(recording.file).stem().string());
  }
  names = identifiers(names);
  const auto write = [&out](const Variable& variable) {
    return variable && Mat_VarWrite(out.get(), variable.get(), MAT_COMPRESSION_ZLIB) == 0;
  };
  if (!write(rig_variable(session.rig, names[0])))
    return failure("the rig cannot be written as MATLAB version 5");
  for (std::size_t i = 0; i < session.recordings.size(); ++i) {
    const Recording& recording = session.recordings[i];
    if (!write(recording_variable(recording, names[i + 1]))) {
      return failure(fmt::format("{}: cannot be written as MATLAB version 5", recording.file));
    }
  }
  out.reset();
  auto bytes = read_file(file.path());
  if (bytes && !holds_elements(*bytes, names.size())) {
    return failure("session.mat: came out incomplete, matio ran out of room for it; nothing was written");
  }
  return bytes;
}

}  // namespace cartwright
