#include "host/session/json_rows.hpp"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "host/session/files.hpp"

namespace cartwright {
namespace {

using Json = nlohmann::json;

bool is_rows(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

/// The array that holds the rows.
Result<const Json*> find_rows(const Json& document, std::string_view key, const std::string& source) {
  if (is_rows(document)) return &document;
  std::vector<std::string> found;
  const Json* only = nullptr;
  if (document.is_object()) {
    for (const auto& [name, value] : document.items()) {
      if (!is_rows(value)) continue;
      if (name == key) return &value;
      found.push_back(name);
      only = &value;
    }
  }
  if (key.empty() && found.size() == 1) return only;
  if (found.empty()) return failure(fmt::format("{}: holds no array of objects, a row each", source));
  if (key.empty()) {
    return failure(
        fmt::format("{}: holds several arrays of rows ({}); choose with rows = \"{}\" in [recording]", source,
                    fmt::join(found, ", "), found.front()));
  }
  return failure(fmt::format("{}: no array of rows {}; it has {}", source, key, fmt::join(found, ", ")));
}

}  // namespace

Result<CsvTable> read_json_rows(const std::filesystem::path& file, std::string_view key) {
  const std::string source = file.string();
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  const Json document = Json::parse(*text, nullptr, false);
  if (document.is_discarded()) return failure(fmt::format("{}: not JSON", source));
  const auto rows = find_rows(document, key, source);
  if (!rows) return tl::unexpected(rows.error());

  CsvTable table;
  std::map<std::string, std::size_t> column_of;
  const std::size_t count = (*rows)->size();
  std::size_t row = 0;
  for (const Json& entry : **rows) {
    if (!entry.is_object()) return failure(fmt::format("{}: row {} is no object", source, row + 1));
    for (const auto& [name, value] : entry.items()) {
      if (!value.is_number() && !value.is_boolean()) continue;
      const auto [at, fresh] = column_of.emplace(name, table.names.size());
      if (fresh) {
        table.names.push_back(name);
        table.columns.emplace_back(count, std::numeric_limits<double>::quiet_NaN());
      }
      table.columns[at->second][row] = value.is_boolean() ? double(value.get<bool>()) : value.get<double>();
    }
    ++row;
  }
  return table;
}

}  // namespace cartwright
