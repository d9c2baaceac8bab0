#pragma once

#include "host/diagnose/drive/drive_balance.hpp"
#include "host/report/report.hpp"

namespace cartwright {

/// What the drive of a held speed balances and what of it is explained: its lines, their error on quarters of
/// the way that were not used, and the drive over the way.
void add_drive(report::Report& page, const DriveBalance& drive, const Session& session);

}  // namespace cartwright
