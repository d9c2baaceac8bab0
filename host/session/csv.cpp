#include "host/session/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

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

/// Where the first cell of a line ends; separators between quotes are part of it.
std::size_t end_of_cell(std::string_view line, char separator) {
  const auto first = line.find_first_not_of(' ');
  if (first != std::string_view::npos && line[first] == '"') {
    auto close = line.find('"', first + 1);
    while (close != std::string_view::npos && line.substr(close + 1).starts_with('"'))
      close = line.find('"', close + 2);
    if (close != std::string_view::npos) return line.find(separator, close);
  }
  return line.find(separator);
}

/// The start of a cell, fit to be shown.
std::string shown(std::string_view cell) {
  std::string text(cell.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

/// A number, NaN for an empty cell; nothing for anything else.
std::optional<double> number_in(std::string_view cell, char separator) {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return value;
  if (cell.front() == '+') cell.remove_prefix(1);
  std::string with_point;
  if (separator != ',' && cell.find(',') != std::string_view::npos) {  // decimal comma
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

/// Columns of text leave the table.
void set_aside_texts(CsvTable& table, std::vector<std::string> first_texts) {
  for (std::size_t i = table.names.size(); i-- > 0;) {
    if (first_texts[i].empty()) continue;
    table.texts.emplace(std::move(table.names[i]), std::move(first_texts[i]));
    table.names.erase(table.names.begin() + static_cast<std::ptrdiff_t>(i));
    table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Takes the next line off `text`; lines end with LF, CR LF or CR.
std::string_view next_line(std::string_view& text) {
  const auto end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos) {
    text = {};
  } else {
    text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : 1));
  }
  return line;
}

/// UTF-16 has a zero byte beside every plain letter.
bool is_no_text(std::string_view text) {
  return text.substr(0, 200).find('\0') != std::string_view::npos;
}

}  // namespace

const std::vector<double>* CsvTable::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

Result<const std::vector<double>*> CsvTable::required(std::string_view name, std::string_view source,
                                                      std::string_view what) const {
  if (const std::vector<double>* found = find(name)) return found;
  if (const auto text = texts.find(name); text != texts.end()) return failure(text->second);
  return failure(fmt::format("{}: no {} {}; it has {}", source, what, name, fmt::join(names, ", ")));
}

Result<CsvTable> parse_csv(std::string_view text, std::string_view source) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (is_no_text(text))
    return failure(fmt::format("{}:1: this is UTF-16 or no text at all; save it as CSV in UTF-8", source));
  CsvTable table;
  std::size_t line_number = 1;
  std::string_view header = next_line(text);
  if (trim(header).empty()) return failure(fmt::format("{}:1: no header line; it names the columns", source));
  const char separator = separator_of(header);
  const auto cells = [separator](std::string_view line, auto&& visit) {
    while (true) {
      const auto end = end_of_cell(line, separator);
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
  std::vector<std::string> first_texts(table.names.size());
  while (!text.empty()) {
    const std::string_view line = next_line(text);
    ++line_number;
    if (trim(line).empty()) continue;
    std::size_t column = 0;
    cells(line, [&](std::string_view cell) {
      if (column >= table.columns.size()) {
        if (ends_with_separator && cell.empty()) return false;
        ++column;
        return false;
      }
      const std::optional<double> value = number_in(cell, separator);
      if (!value && first_texts[column].empty()) {
        first_texts[column] = fmt::format("{}:{}: {} is '{}', a number is needed", source, line_number,
                                          table.names[column], shown(cell));
      }
      table.columns[column++].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
      return true;
    });
    if (column != table.columns.size()) {
      return failure(fmt::format("{}:{}: {} cells, the header has {}", source, line_number, column,
                                 table.columns.size()));
    }
  }
  set_aside_texts(table, std::move(first_texts));
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
