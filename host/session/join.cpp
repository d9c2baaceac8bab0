#include "host/session/join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host/session/rate.hpp"

namespace cartwright {
Result<Session> joined(Session before, Session more) {
  Rig& rig = before.rig;
  if (!same_rate(more.rig.sample_rate_hz, rig.sample_rate_hz)) {
    return failure(fmt::format("{:.6g} Hz, the session there has {:.6g} Hz; a session has one sample rate",
                               more.rig.sample_rate_hz, rig.sample_rate_hz));
  }
  if (more.rig.encoder_resolution_m != rig.encoder_resolution_m) {
    return failure(fmt::format("an encoder of {:.6g} m, the session there has one of {:.6g} m",
                               more.rig.encoder_resolution_m, rig.encoder_resolution_m));
  }
  rig.voltage_limit_V = std::max(rig.voltage_limit_V, more.rig.voltage_limit_V);
  rig.travel_m = {std::min(rig.travel_m[0], more.rig.travel_m[0]),
                  std::max(rig.travel_m[1], more.rig.travel_m[1])};
  std::erase_if(before.recordings, [&](const Recording& old) {
    return std::any_of(more.recordings.begin(), more.recordings.end(),
                       [&](const Recording& one) { return one.file == old.file; });
  });
  std::move(more.recordings.begin(), more.recordings.end(), std::back_inserter(before.recordings));
  return before;
}

}  // namespace cartwright
