#include "host/session/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "host/session/files.hpp"

namespace cartwright {
namespace {

std::string_view trim(std::string_view cell) {
  constexpr std::string_view kSpace = " \t\r";
  const auto first = cell.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  cell = cell.substr(first, cell.find_last_not_of(kSpace) - first + 1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  return cell;
}

char separator_of(std::string_view header) {
  for (const char candidate : {',', ';', '\t'}) {
    if (header.find(candidate) != std::string_view::npos) return candidate;
  }
  return ',';
}

/// Takes the next line off `text`.
std::string_view next_line(std::string_view& text) {
  const auto end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

const std::vector<double>* CsvTable::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

Result<CsvTable> parse_csv(std::string_view text, std::string_view source) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  CsvTable table;
  std::size_t line_number = 1;
  std::string_view header = next_line(text);
  if (trim(header).empty()) return failure(fmt::format("{}:1: no header line; it names the columns", source));
  const char separator = separator_of(header);
  const auto cells = [separator](std::string_view line, auto&& visit) {
    while (true) {
      const auto end = line.find(separator);
      if (!visit(trim(line.substr(0, end)))) return;
      if (end == std::string_view::npos) return;
      line.remove_prefix(end + 1);
    }
  };
  cells(header, [&](std::string_view name) {
    table.names.emplace_back(name);
    return true;
  });
  // Some programs end every line with a separator: a nameless last column that stays empty.
  const bool ends_with_separator = table.names.size() > 1 && table.names.back().empty();
  if (ends_with_separator) table.names.pop_back();
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    if (table.names[i].empty()) return failure(fmt::format("{}:1: column {} has no name", source, i + 1));
    if (std::count(table.names.begin(), table.names.end(), table.names[i]) > 1) {
      return failure(fmt::format("{}:1: two columns are named {}", source, table.names[i]));
    }
  }
  table.columns.resize(table.names.size());
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    ++line_number;
    if (trim(line).empty()) continue;
    std::size_t column = 0;
    std::string problem;
    cells(line, [&](std::string_view cell) {
      if (column >= table.columns.size()) {
        if (ends_with_separator && cell.empty()) return false;
        ++column;
        return false;
      }
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!cell.empty()) {
        if (cell.front() == '+') cell.remove_prefix(1);
        std::string with_point;
        if (separator != ',' && cell.find(',') != std::string_view::npos) {  // decimal comma
          with_point = cell;
          std::replace(with_point.begin(), with_point.end(), ',', '.');
          cell = with_point;
        }
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc{} || end != cell.data() + cell.size()) {
          std::string shown(cell.substr(0, 40));
          std::replace_if(
              shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
          problem = fmt::format("{}:{}: {} is '{}', a number is needed", source, line_number,
                                table.names[column], shown);
          return false;
        }
      }
      table.columns[column++].push_back(value);
      return true;
    });
    if (!problem.empty()) return failure(std::move(problem));
    if (column != table.columns.size()) {
      return failure(fmt::format("{}:{}: {} cells, the header has {}", source, line_number, column,
                                 table.columns.size()));
    }
  }
  return table;
}

Result<CsvTable> read_csv(const std::filesystem::path& file) {
  return read_file(file).and_then([&](const std::string& text) { return parse_csv(text, file.string()); });
}

std::vector<std::string> csv_identifiers(std::vector<std::string> names) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string& name = names[i];
    for (char& c : name) {
      if (!is_letter(c) && !(c >= '0' && c <= '9')) c = '_';
    }
    if (name.empty() || !is_letter(name.front())) name.insert(0, "x_");
    const std::string plain = name;
    const auto taken = [&] {
      return std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), name) !=
             names.begin() + static_cast<std::ptrdiff_t>(i);
    };
    for (int copy = 2; taken(); ++copy) name = fmt::format("{}_{}", plain, copy);
  }
  return names;
}

std::string to_csv(const CsvTable& table) {
  fmt::memory_buffer out;
  auto end = fmt::appender(out);
  fmt::format_to(end, "{}\n", fmt::join(csv_identifiers(table.names), ","));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      if (column > 0) out.push_back(',');
      const double value = table.columns[column][row];
      if (!std::isnan(value)) fmt::format_to(end, "{}", value);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace cartwright
