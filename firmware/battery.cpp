#include <algorithm>

#include "firmware/programme.hpp"

namespace cartwright::firmware {
namespace {

using wire::ExperimentKind;

MultisineSetup multisine(double amplitude, double low_hz, double high_hz, int lines, std::uint32_t seed,
                         double period_s) {
  MultisineSetup setup;
  setup.amplitude = amplitude;
  setup.low_hz = low_hz;
  setup.high_hz = high_hz;
  setup.lines = lines;
  setup.seed = seed;
  setup.period_s = period_s;
  return setup;
}

Step alternating(double amplitude_m) {
  return Step({amplitude_m, StepPattern::alternating, 1, 0.2, 1.5, 6});
}

Relay cycling(const RigFile& rig) {
  RelaySetup setup;
  setup.stop = false;
  setup.start_m = relay_start_m(rig);
  setup.deadband_m = 3 * rig.rig.encoder_resolution_m;
  return Relay(setup);
}

}  // namespace

Programme battery(const RigFile& rig) {
  const double scale = std::clamp(0.6 * shorter_travel_m(rig) / 0.2, 0.0, 1.0);
  // A limit cycle and a dither move the cart in proportion to their voltage.
  const double voltage = std::min(scale, rig.rig.voltage_limit_V / 12);
  const double period_s = rig.rig.period_s();
  constexpr PdGains kStep{60, 0, 50, false}, kFirm{80, 3, 50, false}, kTrackA{80, 2, 50, false},
      kTrackB{60, 1, 50, false}, kSweep{100, 2, 50, false}, kDither{30, 1, 50, false};

  Programme programme;
  programme.kind = ExperimentKind::battery;
  const auto add = [&](std::string_view file, ExperimentKind kind, auto experiment, Law law,
                       std::size_t repeat_of = 0) {
    programme.runs[programme.count++] = Run{FileName(file), kind, experiment, law, repeat_of};
  };
  MultisineSetup dither = multisine(6.5 * voltage, 0.5, 20, 20, 3, period_s);
  dither.logarithmic = true;
  const Sweep sweep({0.15 * scale, 0.1 * scale, 0.3 * scale, 2, 1});
  // Repeats are spread over the session: what drifts in between shows.
  add("step_kp60_1.csv", ExperimentKind::step, alternating(0.1 * scale), kStep);
  add("step_kp80_kd3.csv", ExperimentKind::step, alternating(0.16 * scale), kFirm);
  add("relay_a.csv", ExperimentKind::relay, cycling(rig), DualRelayGains{2.0 * voltage, 1.5 * voltage, 0});
  add("relay_b.csv", ExperimentKind::relay, cycling(rig), DualRelayGains{3.2 * voltage, 2.4 * voltage, 0});
  add("step_kp60_2.csv", ExperimentKind::step, alternating(0.1 * scale), kStep, 1);
  add("track_a.csv", ExperimentKind::track, Track(multisine(0.11 * scale, 0.125, 2, 10, 1, period_s)),
      kTrackA);
  add("sweep.csv", ExperimentKind::sweep, sweep, kSweep);
  add("dither_a.csv", ExperimentKind::dither, Dither(0, dither), kDither);
  add("track_b.csv", ExperimentKind::track, Track(multisine(0.16 * scale, 0.125, 2, 8, 2, period_s)),
      kTrackB);
  add("step_kp60_3.csv", ExperimentKind::step, alternating(0.1 * scale), kStep, 1);
  return programme;
}

}  // namespace cartwright::firmware
