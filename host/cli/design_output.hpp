#pragma once

#include "host/cli/design_options.hpp"
#include "host/design/tuning_rules.hpp"

namespace cartwright::cli {

void print_json(const DesignTask& task, const design::Design& design, const design::RuleComparison& rules);
void print_table(const DesignTask& task, const design::Design& design, const design::RuleComparison& rules);

}  // namespace cartwright::cli
