#pragma once

#include "host/cli/design_options.hpp"

namespace cartwright::cli {

void print_json(const DesignTask& task, const design::Design& design);
void print_table(const DesignTask& task, const design::Design& design);

}  // namespace cartwright::cli
