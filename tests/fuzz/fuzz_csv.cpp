// Any text either is refused in one line or is a table; a table that is written and read again is the same
// table.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "host/session/session.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cartwright;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  auto table = parse_csv(text, "fuzz.csv");
  if (!table) {
    require(table.error().message.starts_with("fuzz.csv:"));
    return 0;
  }
  require(!(table->columns.empty() && table->texts.empty()) && table->names.size() == table->columns.size());
  for (const auto& column : table->columns) require(column.size() == table->rows());
  Recording recording;
  if (!take_columns(recording, *table, "fuzz.csv")) return 0;
  // What is accepted as a recording survives writing and reading.
  const auto again = parse_csv(to_csv(to_table(recording)), "again.csv");
  require(again.has_value());
  const CsvTable written = to_table(recording);
  require(again->names == csv_identifiers(written.names) && again->rows() == written.rows());
  for (std::size_t c = 0; c < written.columns.size(); ++c) {
    for (std::size_t row = 0; row < written.rows(); ++row) {
      require(same(again->columns[c][row], written.columns[c][row]));
    }
  }
  return 0;
}
