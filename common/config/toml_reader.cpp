#include "common/config/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cartwright {

Result<toml::table> parse_toml(std::string_view text, std::string_view source) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("{}:{}: {}", source, error.source().begin.line, error.description()));
  }
}

std::string TomlReader::where() const {
  return fmt::format("{}:{}", source_, table_->source().begin.line);
}

std::string TomlReader::where(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return node ? fmt::format("{}:{}", source_, node->source().begin.line) : where();
}

Result<double> TomlReader::required_number(std::string_view key, double least, double most) const {
  const toml::node* node = table_->get(key);
  if (!node) return failure(fmt::format("{}: {} is missing", where(), key));
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value))
    return failure(fmt::format("{}: {} must be a finite number", where(key), key));
  if (*value < least || *value > most) {
    return failure(fmt::format("{}: {} = {} is outside [{}, {}]", where(key), key, *value, least, most));
  }
  return *value;
}

Result<double> TomlReader::number(std::string_view key, double fallback, double least, double most) const {
  return has(key) ? required_number(key, least, most) : Result<double>(fallback);
}

Result<std::string> TomlReader::text(std::string_view key, std::string fallback) const {
  const toml::node* node = table_->get(key);
  if (!node) return fallback;
  if (!node->is_string()) return failure(fmt::format("{}: {} must be text in quotes", where(key), key));
  return node->value_or(std::string{});
}

Result<std::string> TomlReader::required_text(std::string_view key, std::string_view what) const {
  if (!has(key)) return failure(fmt::format("{}: {} is missing ({})", where(), key, what));
  return text(key, "");
}

Result<bool> TomlReader::flag(std::string_view key, bool fallback) const {
  const toml::node* node = table_->get(key);
  if (!node) return fallback;
  if (!node->is_boolean()) return failure(fmt::format("{}: {} must be true or false", where(key), key));
  return node->value_or(fallback);
}

Result<std::vector<double>> TomlReader::numbers(std::string_view key, std::size_t count) const {
  const toml::array* array = (*table_)[key].as_array();
  if (!array || array->size() != count) {
    return failure(fmt::format("{}: {} must be a list of {} numbers", where(key), key, count));
  }
  std::vector<double> values;
  for (const toml::node& node : *array) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) {
      return failure(fmt::format("{}: {} must be a list of {} numbers", where(key), key, count));
    }
    values.push_back(*value);
  }
  return values;
}

Result<std::optional<TomlReader>> TomlReader::table(std::string_view key) const {
  const toml::node* node = table_->get(key);
  if (!node) return std::optional<TomlReader>{};
  if (!node->is_table()) return failure(fmt::format("{}: {} must be a table", where(key), key));
  return std::optional<TomlReader>(TomlReader(*node->as_table(), source_));
}

Result<std::vector<TomlReader>> TomlReader::tables(std::string_view key) const {
  std::vector<TomlReader> list;
  const toml::node* node = table_->get(key);
  if (!node) return list;
  const toml::array* array = node->as_array();
  if (!array || !array->is_homogeneous(toml::node_type::table)) {
    return failure(fmt::format("{}: write [[{}]], once for each", where(key), key));
  }
  for (const toml::node& entry : *array) list.emplace_back(*entry.as_table(), source_);
  return list;
}

Result<void> TomlReader::only(std::initializer_list<std::string_view> known) const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
      return failure(fmt::format("{}:{}: unknown key {}; known are {}", source_, key.source().begin.line,
                                 key.str(), fmt::join(known, ", ")));
    }
  }
  return {};
}

}  // namespace cartwright
