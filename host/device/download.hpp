#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/device/controller.hpp"
#include "host/session/session.hpp"

namespace cartwright::device {

/// One recording as the controller lists it.
struct RecordingInfo {
  std::string file;
  std::string experiment;
  ControllerSpec controller;
  wire::Outcome outcome = wire::Outcome::none;
  unsigned repeat_of = 0;  ///< 1 + the recording it repeats, 0 for none
  std::uint64_t first_row = 0, rows = 0;
  std::uint64_t lost_rows = 0;  ///< ticks missed and rows overwritten
};

struct Download {
  Session session;
  /// What did not come over, in words, one line each; empty where everything did.
  std::vector<std::string> losses;
};

/// Called with the part that is done, 0 to 1.
using Progress = std::function<void(double)>;

/// Recordings [first, last) of the controller's list.
struct Range {
  std::size_t first = 0, last = 0;
};

Answer<std::size_t> recording_count(Controller& controller);

/// Fetches recordings out of the controller's log into a session: page after page, each checked against its
/// checksum and asked for again where it is damaged; a broken connection is made anew and the transfer goes
/// on where it stopped.
///
/// Times start at zero at a recording's first row, also where that row is lost, so that the loss shows as a
/// late start. Columns without a single number (no current sensor, no truth) are left out. Two recordings of
/// the same name become NAME.csv and NAME_2.csv.
Answer<Download> download(Controller& controller, Range range, const Progress& progress = {});

}  // namespace cartwright::device
