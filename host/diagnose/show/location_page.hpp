#pragma once

#include "host/diagnose/diagnosis.hpp"
#include "host/report/report.hpp"

namespace cartwright {

/// "Where does the model fail?": a section with a plot of every axis that is not flat, before and after, the
/// names of those that are, and what repeats have in common.
void add_location(report::Report& page, const Diagnosis& diagnosis);

/// The missing push along one axis with its band, and what is left of it after; `after` may be empty.
report::Plot map_plot(const AxisMap& before, const AxisMap& after);

}  // namespace cartwright
