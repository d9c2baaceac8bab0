#include "firmware/programme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cartwright::firmware {
namespace {

using wire::ExperimentKind;
using wire::Id;

/// A relay test that stops by itself ends at the latest after this.
constexpr double kMostRelay_s = 60;

MultisineSetup track_setup(const Settings& s, double period_s) {
  MultisineSetup setup;
  const bool sine = s.integer(Id::track_shape) == 1;
  setup.amplitude = s[Id::track_amplitude_m];
  setup.low_hz = s[Id::track_low_hz];
  setup.high_hz = s[Id::track_high_hz];
  setup.lines = sine ? 1 : s.integer(Id::track_lines);
  setup.duration_s = s[Id::experiment_duration_s];
  setup.period_s = period_s;
  setup.seed = static_cast<std::uint32_t>(s[Id::track_seed]);
  return setup;
}

MultisineSetup dither_setup(const Settings& s, double period_s) {
  MultisineSetup setup;
  setup.amplitude = s[Id::dither_amplitude_V];
  setup.low_hz = s[Id::dither_low_hz];
  setup.high_hz = s[Id::dither_high_hz];
  setup.lines = s.integer(Id::dither_lines);
  setup.logarithmic = true;
  setup.duration_s = s[Id::experiment_duration_s];
  setup.period_s = period_s;
  setup.seed = static_cast<std::uint32_t>(s[Id::dither_seed]);
  return setup;
}

StepSetup step_setup(const Settings& s) {
  return {s[Id::step_amplitude_m],    static_cast<StepPattern>(s.integer(Id::step_pattern)),
          s.integer(Id::step_levels), s[Id::step_delay_s],
          s[Id::step_interval_s],     s[Id::experiment_duration_s]};
}

RelaySetup relay_setup(const Settings& s, const RigFile& rig) {
  RelaySetup setup;
  setup.start_m = relay_start_m(rig);
  setup.settle_s = s[Id::relay_settle_s];
  setup.tolerance = s[Id::relay_tolerance];
  setup.cycles = s.integer(Id::relay_cycles);
  setup.stop = s.flag(Id::relay_stop);
  setup.duration_s = setup.stop ? kMostRelay_s : s[Id::experiment_duration_s];
  setup.deadband_m = std::max(3 * rig.rig.encoder_resolution_m, 0.5 * s[Id::relay_hysteresis_m]);
  return setup;
}

Result<void> within_travel(const RigFile& rig, double position_m, std::string_view what) {
  const double low = rig.rig.travel_m[0] + rig.travel_margin_m,
               high = rig.rig.travel_m[1] - rig.travel_margin_m;
  if (position_m >= low && position_m <= high) return {};
  return failure(
      fmt::format("{} asks for {} m; the travel less its margin is [{}, {}] m", what, position_m, low, high));
}

Result<void> band(double low_hz, double high_hz, double rate_hz, std::string_view what) {
  if (low_hz <= high_hz && high_hz < rate_hz / 2) return {};
  return failure(
      fmt::format("{}_low_hz = {} and {}_high_hz = {} must rise and stay below half the rate of {} Hz", what,
                  low_hz, what, high_hz, rate_hz));
}

}  // namespace

FileName::FileName(std::string_view name) {
  std::copy_n(name.begin(), std::min(name.size(), text.size() - 1), text.begin());
}

double shorter_travel_m(const RigFile& rig) {
  return std::min(-rig.rig.travel_m[0], rig.rig.travel_m[1]) - rig.travel_margin_m;
}

double relay_start_m(const RigFile& rig) {
  constexpr double kPartOfTravel = 0.05;
  return -kPartOfTravel * std::max(0.0, shorter_travel_m(rig));
}

Result<Programme> prepare(const Settings& s, const RigFile& rig) {
  const auto kind = static_cast<ExperimentKind>(s.integer(Id::experiment_kind));
  if (kind == ExperimentKind::battery) return battery(rig);
  const double period_s = rig.rig.period_s();
  Programme programme;
  programme.kind = kind;
  programme.count = 1;
  Run& run = programme.runs[0];
  run.kind = kind;
  run.file = FileName(fmt::format("{}.csv", wire::name(kind)));
  if (s.flag(Id::experiment_own_gains)) run.law = s.gains_from(Id::experiment_kp_V_per_m);
  std::vector<Result<void>> checks;
  switch (kind) {
    case ExperimentKind::step:
      run.experiment = Step(step_setup(s));
      checks = {within_travel(rig, s[Id::step_amplitude_m], "step_amplitude_m")};
      break;
    case ExperimentKind::relay:
      run.experiment = Relay(relay_setup(s, rig));
      run.law = DualRelayGains{s[Id::relay_h1_V], s[Id::relay_h2_V], s[Id::relay_hysteresis_m]};
      checks = {within_travel(rig, 0, "the relay")};
      break;
    case ExperimentKind::track: {
      const MultisineSetup setup = track_setup(s, period_s);
      checks = {within_travel(rig, setup.amplitude, "track_amplitude_m"),
                within_travel(rig, -setup.amplitude, "track_amplitude_m"),
                band(setup.low_hz, setup.lines == 1 ? setup.low_hz : setup.high_hz, rig.rig.sample_rate_hz,
                     "track")};
      run.experiment = Track(setup);
      break;
    }
    case ExperimentKind::sweep: {
      const Sweep sweep({s[Id::sweep_amplitude_m], s[Id::sweep_slowest_m_per_s], s[Id::sweep_fastest_m_per_s],
                         s.integer(Id::sweep_speeds), s[Id::sweep_acceleration_m_per_s2]});
      checks = {within_travel(rig, s[Id::sweep_amplitude_m], "sweep_amplitude_m"),
                within_travel(rig, -s[Id::sweep_amplitude_m], "sweep_amplitude_m")};
      if (!sweep.possible()) {
        checks.push_back(failure(fmt::format("sweep: {} m/s cannot be reached in {} m with {} m/s^2",
                                             s[Id::sweep_fastest_m_per_s], 2 * s[Id::sweep_amplitude_m],
                                             s[Id::sweep_acceleration_m_per_s2])));
      }
      run.experiment = sweep;
      break;
    }
    case ExperimentKind::dither: {
      const MultisineSetup setup = dither_setup(s, period_s);
      checks = {within_travel(rig, s[Id::dither_position_m], "dither_position_m"),
                band(setup.low_hz, setup.high_hz, rig.rig.sample_rate_hz, "dither")};
      run.experiment = Dither(s[Id::dither_position_m], setup);
      break;
    }
    case ExperimentKind::hold:
      run.experiment = Hold(s[Id::hold_position_m], s[Id::experiment_duration_s]);
      checks = {within_travel(rig, s[Id::hold_position_m], "hold_position_m")};
      break;
    default:
      return failure("experiment_kind names no experiment");
  }
  for (const Result<void>& check : checks) {
    if (!check) return tl::unexpected(check.error());
  }
  return programme;
}

}  // namespace cartwright::firmware
