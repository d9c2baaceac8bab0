#pragma once

#include <vector>

namespace cartwright::reproduce {

/// First time the response reaches a level; infinite if never. Straight lines between samples.
double reaches_s(const std::vector<double>& y, double period_s, double level);

/// Rise from 10 to 90 %, overshoot and settling of a step from 0 to `final_value`; samples evenly spaced from
/// the step on, straight lines between.
struct StepMeasures {
  double rise_s = 0;      ///< infinite if 90 % is never reached
  double overshoot = 0;   ///< share of the step
  double settling_s = 0;  ///< last time the response is outside the band; infinite if it is at the end
};

StepMeasures measure_step(const std::vector<double>& y, double period_s, double final_value,
                          double band = 0.01);

}  // namespace cartwright::reproduce
