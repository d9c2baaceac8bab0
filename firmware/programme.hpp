#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <variant>

#include "common/control/dual_relay.hpp"
#include "common/control/pd.hpp"
#include "common/result.hpp"
#include "firmware/experiments/dither.hpp"
#include "firmware/experiments/hold.hpp"
#include "firmware/experiments/relay.hpp"
#include "firmware/experiments/step.hpp"
#include "firmware/experiments/sweep.hpp"
#include "firmware/experiments/track.hpp"
#include "firmware/rig_file.hpp"
#include "firmware/settings.hpp"

namespace cartwright::firmware {

/// A file name that lives without the heap.
struct FileName {
  std::array<char, 32> text{};  ///< ends with a zero
  FileName() = default;
  explicit FileName(std::string_view name);
  std::string_view view() const noexcept { return text.data(); }
};

/// PD with gains of its own, PD with whatever gains are active, or the dual relay.
struct ActiveGains {};
using Law = std::variant<ActiveGains, PdGains, DualRelayGains>;

/// One recording to make.
struct Run {
  FileName file;
  wire::ExperimentKind kind = wire::ExperimentKind::none;
  std::variant<Hold, Step, Relay, Track, Sweep, Dither> experiment;
  Law law;
  std::size_t repeat_of = 0;  ///< 1 + the place in the programme of the run it repeats, 0 for none
};

/// What a `run` command starts: one run, or the ten of a battery. Made ready outside the loop (phases drawn,
/// greatest values found), so that the loop only copies it.
struct Programme {
  static constexpr std::size_t kMostRuns = 10;
  wire::ExperimentKind kind = wire::ExperimentKind::none;
  std::array<Run, kMostRuns> runs;
  std::size_t count = 0;
};

/// What the travel, less its margin, leaves on the shorter side of zero; negative where zero is outside.
double shorter_travel_m(const RigFile& rig);

/// Where a relay test starts: to one side of zero by a twentieth of that. At zero itself the relays hold the
/// cart in unstable balance, and the phase of the cycle that grows is settled within one encoder count.
double relay_start_m(const RigFile& rig);

/// The programme that the experiment registers describe. Fails, saying why, where numbers that are in range
/// each do not fit together or do not fit the rig: a reference outside the travel, a sweep too fast for its
/// length.
Result<Programme> prepare(const Settings& settings, const RigFile& rig);

/// The standard set for identification: three repeats of a step (kp 60), a step with kp 80 and kd 3, two dual
/// relays, two tracks, a sweep and a dither, 6 to 8 s each. Smaller where the rig's travel is: distances
/// scale so that the largest reference stays within 60 % of the shorter side, never above the standard.
Programme battery(const RigFile& rig);

}  // namespace cartwright::firmware
