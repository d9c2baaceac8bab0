#pragma once

#include <string>

#include "common/result.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// One recording as a ULog file, which PlotJuggler and Foxglove open directly.
///
/// Topics: `tick`, one message per row with every column (names made identifiers, empty cells NaN) and `t_s`
/// itself; `gains`, the controller's numbers, at the first and the last row, so that they draw as a line
/// beside the ticks. Timestamps are t_s in microseconds, counted from the first row where t_s is negative.
/// Every stretch of lost rows is a dropout message in its place, and a warning in words. Info holds the rig
/// and the experiment, parameters the gains.
Result<std::string> to_ulog(const Rig& rig, const Recording& recording);

}  // namespace cartwright
