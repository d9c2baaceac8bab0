#pragma once

#include <string>
#include <vector>

#include "host/design/design.hpp"
#include "host/design/tuning_rules.hpp"
#include "host/report/report.hpp"

namespace cartwright::design {

/// What a page on a design shows.
struct DesignPage {
  std::string model_name, rig_name;
  std::vector<ParameterInterval> intervals;
  const Trials& trials;
  const SearchSettings& search;
  const Design& design;
  const RuleComparison& rules;
  bool integral = false;
  std::string gain_file;  ///< its text; empty where there is none
};

/// The answer, the map of gains, the predicted response with its band, and the rules beside it.
report::Report design_page(const DesignPage& content);

/// Map of one integral part, with outlines of where the specification is met; a curve where one gain is
/// fixed.
report::Plot map_plot(const DesignPage& content, const GainMap& map);

}  // namespace cartwright::design
