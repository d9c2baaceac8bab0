#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

Result<toml::table> parse_toml(std::string_view text, std::string_view source);

/// Looks into one TOML table and says in one line, with file, line and key, what is wrong with what it finds.
/// Refers to the table: keep the document.
class TomlReader {
 public:
  TomlReader(const toml::table& table, std::string source) : table_(&table), source_(std::move(source)) {}

  bool has(std::string_view key) const { return table_->contains(key); }
  const toml::table& raw() const { return *table_; }
  const std::string& source() const { return source_; }
  std::string where() const;
  std::string where(std::string_view key) const;

  /// A finite number within [least, most].
  Result<double> number(std::string_view key, double fallback, double least, double most) const;
  Result<double> required_number(std::string_view key, double least, double most) const;
  Result<std::string> text(std::string_view key, std::string fallback) const;
  Result<std::string> required_text(std::string_view key, std::string_view what) const;
  Result<bool> flag(std::string_view key, bool fallback) const;
  Result<std::vector<double>> numbers(std::string_view key, std::size_t count) const;
  Result<std::optional<TomlReader>> table(std::string_view key) const;
  Result<std::vector<TomlReader>> tables(std::string_view key) const;

  /// Fails at the first key that is not among `known`.
  Result<void> only(std::initializer_list<std::string_view> known) const;

 private:
  const toml::table* table_;
  std::string source_;
};

}  // namespace cartwright
