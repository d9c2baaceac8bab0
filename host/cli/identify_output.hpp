#pragma once

#include "host/identify/identify.hpp"
#include "host/identify/simulation_fit.hpp"
#include "host/identify/step_response.hpp"

namespace cartwright::cli {

// What `cartwright identify` prints: one JSON object, or a table.
void print_json(const Identification& result);
void print_json(const StepIdentification& result);
void print_json(const SimulationFit& result);
void print_table(const Identification& result);
void print_table(const StepIdentification& result);
void print_table(const SimulationFit& result);

}  // namespace cartwright::cli
