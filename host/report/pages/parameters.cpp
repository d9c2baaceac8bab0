#include "host/report/pages/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/unit.hpp"

namespace cartwright::report {
namespace {

std::string name_of(const ParameterInfo& parameter) {
  const std::string key = words_of(parameter.key);
  return parameter.term ? words_of(info(*parameter.term).name) + ", " + key : key;
}

/// With its interval; or as somebody states it, whose own digits count.
Cell cell_of(const Estimate& estimate) {
  if (estimate.has_interval()) return estimate;
  Cell cell{fmt::format("{:.6g}", estimate.value)};
  cell.numeric = true;
  return cell;
}

}  // namespace

ParameterColumn column_of(std::string heading, const Model& model) {
  ParameterColumn out{std::move(heading), {}};
  for (const ParameterInfo& parameter : parameters()) {
    if (!parameter.term || model.has(*parameter.term)) out.values[parameter.id] = {model[parameter.id]};
  }
  return out;
}

ParameterColumn column_of(const NamedModel& model) {
  ParameterColumn out = column_of(model.name, model.model);
  for (const ParameterInterval& interval : model.intervals) {
    Estimate& estimate = out.values[interval.id];
    estimate.low = interval.low;
    estimate.high = interval.high;
  }
  return out;
}

Table parameters_table(std::string caption, const std::vector<ParameterColumn>& columns) {
  Table table;
  table.caption = std::move(caption);
  table.intervals_below = true;
  table.columns = {{"Parameter"}, {"Unit"}};
  for (const ParameterColumn& column : columns) table.columns.push_back({column.heading});
  for (const ParameterInfo& parameter : parameters()) {
    const bool any = std::any_of(columns.begin(), columns.end(), [&](const ParameterColumn& column) {
      return column.values.contains(parameter.id);
    });
    if (!any) continue;
    std::vector<Cell> cells{name_of(parameter), unit_of(parameter.key)};
    for (const ParameterColumn& column : columns) {
      const auto found = column.values.find(parameter.id);
      Cell none{"–"};
      none.numeric = true;
      cells.push_back(found == column.values.end() ? none : cell_of(found->second));
    }
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace cartwright::report
