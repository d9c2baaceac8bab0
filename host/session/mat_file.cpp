#include "host/session/mat_file.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

namespace cartwright {

struct MatFile::Handle {
  mat_t* mat = nullptr;
  explicit Handle(mat_t* opened) : mat(opened) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { Mat_Close(mat); }
};

namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

template <typename T>
void append(const matvar_t& variable, std::size_t first, std::size_t stride, std::size_t count,
            std::vector<double>& out) {
  const T* data = static_cast<const T*>(variable.data);
  for (std::size_t i = 0; i < count; ++i) out.push_back(static_cast<double>(data[first + i * stride]));
}

/// Copies `count` numbers from `first`, `stride` apart; false where the class holds no real numbers.
bool copy_numbers(const matvar_t& variable, std::size_t first, std::size_t stride, std::size_t count,
                  std::vector<double>& out) {
  if (variable.isComplex != 0 || variable.data == nullptr) return false;
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      append<double>(variable, first, stride, count, out);
      return true;
    case MAT_T_SINGLE:
      append<float>(variable, first, stride, count, out);
      return true;
    case MAT_T_INT8:
      append<std::int8_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_UINT8:
      append<std::uint8_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_INT16:
      append<std::int16_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_UINT16:
      append<std::uint16_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_INT32:
      append<std::int32_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_UINT32:
      append<std::uint32_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_INT64:
      append<std::int64_t>(variable, first, stride, count, out);
      return true;
    case MAT_T_UINT64:
      append<std::uint64_t>(variable, first, stride, count, out);
      return true;
    default:
      return false;
  }
}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
}

}  // namespace

Result<MatFile> MatFile::open(const std::filesystem::path& file) {
  if (!std::ifstream(file)) {
    return failure(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  }
  mat_t* mat = Mat_Open(file.c_str(), MAT_ACC_RDONLY);
  if (mat == nullptr) {
    return failure(fmt::format("{}: not a readable MATLAB file (version 4, 5 or 7.3)", file.string()));
  }
  MatFile opened(std::make_shared<Handle>(mat), file.string());
  if (opened.names().empty()) return failure(fmt::format("{}: holds no variables", file.string()));
  return opened;
}

std::vector<std::string> MatFile::names() const {
  std::size_t count = 0;
  char* const* listed = Mat_GetDir(handle_->mat, &count);
  std::vector<std::string> out;
  for (std::size_t i = 0; listed != nullptr && i < count; ++i) {
    if (listed[i] != nullptr) out.emplace_back(listed[i]);
  }
  return out;
}

Result<std::vector<double>> MatFile::read(const MatSelection& selection) const {
  const auto dot = selection.variable.find('.');
  const std::string top = selection.variable.substr(0, dot);
  const std::unique_ptr<matvar_t, FreeVariable> owner(Mat_VarRead(handle_->mat, top.c_str()));
  if (!owner) {
    return failure(fmt::format("{}: no variable {}; it holds {}", source_, top, fmt::join(names(), ", ")));
  }
  const matvar_t* variable = owner.get();
  for (auto at = dot; at != std::string::npos;) {
    const auto next = selection.variable.find('.', at + 1);
    const std::string field =
        selection.variable.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    if (variable->class_type != MAT_C_STRUCT) {
      return failure(fmt::format("{}: {} is no structure, it has no field {}", source_,
                                 selection.variable.substr(0, at), field));
    }
    variable = Mat_VarGetStructFieldByName(const_cast<matvar_t*>(variable), field.c_str(), 0);
    if (variable == nullptr) {
      return failure(fmt::format("{}: {} has no field {}", source_, selection.variable.substr(0, at), field));
    }
    at = next;
  }
  if (selection.cell) {
    const auto [row, column] = *selection.cell;
    if (variable->class_type != MAT_C_CELL || variable->rank != 2 || row < 1 || column < 1 ||
        row > variable->dims[0] || column > variable->dims[1]) {
      return failure(fmt::format("{}: {} has no cell [{}, {}]", source_, selection.variable, row, column));
    }
    variable = Mat_VarGetCell(const_cast<matvar_t*>(variable),
                              static_cast<int>((column - 1) * variable->dims[0] + row - 1));
    if (variable == nullptr) {
      return failure(fmt::format("{}: {}: cell [{}, {}] is empty", source_, selection.variable, row, column));
    }
  }
  if (variable->class_type == MAT_C_CELL) {
    return failure(fmt::format("{}: {} is a cell array of {} x {}; choose with cell = [row, column]", source_,
                               selection.variable, variable->dims[0], variable->dims[1]));
  }
  if (!is_numeric(*variable) || variable->rank != 2) {
    return failure(fmt::format("{}: {} is not a matrix of real numbers", source_, selection.variable));
  }
  const std::size_t rows = variable->dims[0], columns = variable->dims[1];
  std::size_t first = 0, stride = 1, count = rows * columns;
  if (selection.row) {
    if (*selection.row < 1 || *selection.row > rows) {
      return failure(
          fmt::format("{}: {} has rows 1 to {}, not {}", source_, selection.variable, rows, *selection.row));
    }
    first = *selection.row - 1;
    stride = rows;
    count = columns;
  } else if (selection.column) {
    if (*selection.column < 1 || *selection.column > columns) {
      return failure(fmt::format("{}: {} has columns 1 to {}, not {}", source_, selection.variable, columns,
                                 *selection.column));
    }
    first = (*selection.column - 1) * rows;
    count = rows;
  } else if (rows != 1 && columns != 1) {
    return failure(fmt::format("{}: {} is a matrix of {} x {}; choose with row = N or column = N", source_,
                               selection.variable, rows, columns));
  }
  std::vector<double> out;
  out.reserve(count);
  if (!copy_numbers(*variable, first, stride, count, out)) {
    return failure(fmt::format("{}: {} is not a matrix of real numbers", source_, selection.variable));
  }
  return out;
}

}  // namespace cartwright
