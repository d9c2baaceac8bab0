#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "host/report/pages/named_model.hpp"
#include "host/report/report.hpp"

namespace cartwright::report {

/// One column of a table of parameters: what somebody says the numbers are.
struct ParameterColumn {
  std::string heading;
  std::map<Parameter, Estimate> values;
};

/// The numbers of a model, without intervals, or with those it has.
ParameterColumn column_of(std::string heading, const Model& model);
ParameterColumn column_of(const NamedModel& model);

/// A row for every parameter that any column holds, a column for each; a dash where one says nothing.
Table parameters_table(std::string caption, const std::vector<ParameterColumn>& columns);

}  // namespace cartwright::report
