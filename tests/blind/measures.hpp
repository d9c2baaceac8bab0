#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/statistics/estimate.hpp"
#include "tests/blind/outcome.hpp"

namespace cartwright::blind {

using Outcomes = std::vector<Outcome>;

/// The value that a share of `values` stays below, between order statistics, with its 95 % interval (the
/// order statistics that bracket it whatever the distribution). NaN among the values is left out.
Estimate quantile(std::vector<double> values, double share);

/// One line of the benchmark: what was aimed at and what came out.
struct Measure {
  std::string name;
  std::string target;
  std::string unit;
  Estimate reached;
  std::size_t cases = 0;
  bool met = false;
  std::map<std::string, Estimate> baselines;  ///< the same of each baseline that was asked
};

/// Every measure that the outcomes say something about.
std::vector<Measure> measures(const Outcomes& outcomes);

/// How often names given with about the same confidence were right.
struct ReliabilityBin {
  double low = 0, high = 1;  ///< of the confidence
  double stated = 0;         ///< mean confidence of the names
  int names = 0, right = 0;
  Estimate share_right;
};
std::vector<ReliabilityBin> reliability(const Outcomes& outcomes);

/// A group of sessions that hide one effect of the vocabulary.
struct Detection {
  std::string label;
  double excess_over_floor = 0;  ///< geometric mean over the group
  std::size_t cases = 0;
  Estimate named_first;
  std::map<std::string, Estimate> baselines;
};
/// By the size that was drawn, and in `groups` groups of as many sessions each by the excess of the window
/// error in units of the noise floor.
std::vector<Detection> detection_by_size(const Outcomes& outcomes);
std::vector<Detection> detection_by_excess(const Outcomes& outcomes, std::size_t groups);

/// How one effect fared.
struct EffectRow {
  std::string effect;
  std::map<int, std::pair<int, int>> right_of;  ///< right answers and cases, by size
  Estimate median_error, worst_tenth_error;     ///< relative, over all its parameters
  int covered = 0, parameters = 0;
};
std::vector<EffectRow> by_effect(const Outcomes& outcomes);

/// Names of the baselines that were asked.
std::vector<std::string> baselines_asked(const Outcomes& outcomes);

}  // namespace cartwright::blind
