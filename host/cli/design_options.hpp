#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/rig.hpp"
#include "common/result.hpp"
#include "host/design/design.hpp"

namespace cartwright::cli {

/// What `cartwright design` is told.
struct DesignOptions {
  std::string model, rig, session, relay, out, report;
  std::string law = "pd";
  bool ideal = false, json = false;
  std::optional<double> rate_hz, voltage_limit_V, encoder_m, filter_hz;
  std::string derivative_on = "error";
  double step_m = 0.1, start_m = 0;
  std::optional<double> duration_s;
  double settling_band = 0.02;
  std::array<std::optional<double>, design::kQuantityCount> limits;
  std::string kp, kd, ki;
  double margin = 0.1, gain_change = 0.05;
  unsigned threads = 1;
};

void add_design_options(CLI::App& command, DesignOptions& options);

/// The options as what the library works with, checked against each other.
struct DesignTask {
  Model model;
  std::vector<ParameterInterval> intervals;
  std::string rig_name;
  design::Trials trials;
  design::SearchSettings search;
  bool integral = false;
};
Result<DesignTask> design_task(const DesignOptions& options, const CLI::App& command);

}  // namespace cartwright::cli
