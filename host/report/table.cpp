#include "host/report/table.hpp"

#include <algorithm>

#include "host/report/html.hpp"

namespace cartwright::report {
namespace {

struct ColumnShape {
  bool numeric = false, intervals = false;
};

std::vector<ColumnShape> shapes(const Table& table) {
  std::vector<ColumnShape> out(table.columns.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < std::min(row.size(), out.size()); ++i) {
      out[i].numeric = out[i].numeric || row[i].numeric;
      out[i].intervals = out[i].intervals || !row[i].interval.empty();
    }
  }
  return out;
}

const char* tone_class(Tone tone) {
  switch (tone) {
    case Tone::good:
      return " good";
    case Tone::attention:
      return " attention";
    case Tone::bad:
      return " bad";
    case Tone::plain:
      break;
  }
  return "";
}

std::string cell_html(const Cell& cell, const ColumnShape& shape, bool interval_below) {
  std::string classes = shape.numeric ? "n" : "t";
  classes += tone_class(cell.tone);
  if (cell.strong) classes += " strong";
  std::string out = "<td class=\"" + classes + "\">" + escape(cell.text);
  if (interval_below && !cell.interval.empty())
    out += "<span class=\"below\">" + escape(cell.interval) + "</span>";
  out += "</td>";
  if (shape.intervals && !interval_below) out += "<td class=\"i\">" + escape(cell.interval) + "</td>";
  return out;
}

}  // namespace

Cell::Cell(const Estimate& estimate) {
  const FormattedEstimate shown = format_estimate(estimate);
  text = shown.value;
  interval = shown.interval;
  numeric = true;
}

Cell Cell::number(double value, int significant) {
  Cell cell;
  cell.text = format_number(value, significant);
  cell.numeric = true;
  return cell;
}

Cell Cell::integer(std::size_t value) {
  Cell cell{std::to_string(value)};
  cell.numeric = true;
  return cell;
}

std::string to_html(const Table& table) {
  const std::vector<ColumnShape> columns = shapes(table);
  std::string out = "<figure class=\"table\">";
  if (!table.caption.empty()) out += "<figcaption>" + escape(table.caption) + "</figcaption>";
  out += "<div class=\"scroll\"><table><thead><tr>";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    out += "<th scope=\"col\"";
    if (columns[i].numeric) out += " class=\"n\"";
    if (columns[i].intervals && !table.intervals_below) out += " colspan=\"2\"";
    out += ">" + escape(table.columns[i].heading);
    if (!table.columns[i].unit.empty())
      out += "<span class=\"unit\">" + escape(table.columns[i].unit) + "</span>";
    out += "</th>";
  }
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < columns.size(); ++i)
      out += cell_html(i < row.size() ? row[i] : Cell{}, columns[i], table.intervals_below);
    out += "</tr>\n";
  }
  out += "</tbody></table></div>";
  if (!table.note.empty()) out += "<p class=\"note\">" + escape(table.note) + "</p>";
  return out + "</figure>\n";
}

}  // namespace cartwright::report
