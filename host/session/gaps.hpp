#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/session/session.hpp"

namespace cartwright {

/// A stretch of time without rows inside a recording.
struct Gap {
  std::size_t row;    ///< the first row after it
  double from_s;      ///< time of the last row before it
  double to_s;        ///< time of `row`
  double lost_ticks;  ///< how many rows should have been there, rounded
  double lost_s;      ///< how long they would have taken
};

/// What lies between the `segments` of a recording, in words a person or another program can use. `time_s`
/// increases strictly.
std::vector<Gap> find_gaps(const std::vector<double>& time_s);

/// The gaps of every recording that has some, a line for each recording.
std::vector<std::string> gaps_in_words(const Session& session);

}  // namespace cartwright
