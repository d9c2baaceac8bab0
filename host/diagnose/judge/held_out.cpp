#include "host/diagnose/judge/held_out.hpp"

#include <algorithm>

namespace cartwright {

std::vector<std::size_t> choose_held_out(const Session& session) {
  constexpr std::size_t kLeastRecordings = 4;
  if (session.recordings.size() < kLeastRecordings) return {};
  const auto repeated = [&](const Recording& r) {
    return !r.repeat_of.empty() || std::any_of(session.recordings.begin(), session.recordings.end(),
                                               [&](const Recording& o) { return o.repeat_of == r.file; });
  };
  for (const bool repeats_too : {false, true}) {
    for (std::size_t n = session.recordings.size(); n-- > 0;) {
      const Recording& r = session.recordings[n];
      const auto like = std::count_if(session.recordings.begin(), session.recordings.end(),
                                      [&](const Recording& o) { return o.experiment == r.experiment; });
      if (like > 1 && (repeats_too || !repeated(r)) && r.experiment != "relay") return {n};
    }
  }
  return {session.recordings.size() - 1};
}

Session without(const Session& session, const std::vector<std::size_t>& out) {
  Session kept{session.rig, {}};
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    if (std::find(out.begin(), out.end(), n) == out.end()) kept.recordings.push_back(session.recordings[n]);
  }
  return kept;
}

Session only(const Session& session, const std::vector<std::size_t>& chosen) {
  Session kept{session.rig, {}};
  for (const std::size_t n : chosen) kept.recordings.push_back(session.recordings[n]);
  return kept;
}

}  // namespace cartwright
