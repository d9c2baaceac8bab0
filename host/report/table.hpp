#pragma once

#include <string>
#include <vector>

#include "host/report/number.hpp"

namespace cartwright::report {

/// How a cell or a banner is marked, by a sign and a word as well as by colour.
enum class Tone { plain, good, attention, bad };

struct Cell {
  std::string text;
  std::string interval;  ///< shown beside the text in a narrower column, or below it
  bool numeric = false;
  Tone tone = Tone::plain;
  bool strong = false;

  Cell() = default;
  Cell(const char* plain_text) : text(plain_text) {}             // NOLINT: a text is a cell
  Cell(std::string plain_text) : text(std::move(plain_text)) {}  // NOLINT
  Cell(double value) : Cell(number(value)) {}                    // NOLINT
  Cell(const Estimate& estimate);                                // NOLINT

  static Cell number(double value, int significant = 4);
  static Cell integer(std::size_t value);
  Cell& mark(Tone new_tone) {
    tone = new_tone;
    return *this;
  }
  Cell& emphasise() {
    strong = true;
    return *this;
  }
};

struct Column {
  std::string heading{};
  std::string unit{};  ///< shown below the heading; empty for none
};

/// Numbers stand right-aligned in tabular figures, their intervals beside them. `note` explains below the
/// table.
struct Table {
  std::string caption{};
  std::vector<Column> columns{};
  std::vector<std::vector<Cell>> rows{};
  std::string note{};
  bool intervals_below = false;  ///< below the numbers, where many columns have them

  Table& row(std::vector<Cell> cells) {
    rows.push_back(std::move(cells));
    return *this;
  }
};

std::string to_html(const Table& table);

}  // namespace cartwright::report
