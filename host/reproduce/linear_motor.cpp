#include "host/reproduce/linear_motor.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace cartwright::reproduce {
namespace {

using E = AdaptiveEstimates;

constexpr double kPublishedWithout_um = 11.2, kPublishedWith_um = 1.01;

/// The amplitude at which feedback alone leaves the published error. The error grows with the amplitude, by
/// less than in proportion where friction is most of it.
double published_amplitude_m() {
  double low = 1e-4, high = 0.25;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    TrackingSetup setup = LinearMotor::tracking(CompensationMode::off, LinearMotor::model());
    setup.amplitude_m = middle;
    (1e6 * track(setup).measured_error_rms_m < kPublishedWithout_um ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Trace {
  std::vector<double> time_s, error_um;
};

TrackingResult traced(const TrackingSetup& setup, Trace& trace, double from_s) {
  return track(setup, [&](double time_s, double reference_m, double reading_m, double) {
    if (time_s < from_s || std::fmod(time_s, 2e-3) > setup.period_s) return;
    trace.time_s.push_back(time_s);
    trace.error_um.push_back(1e6 * (reference_m - reading_m));
  });
}

std::string microns(const TrackingResult& result) {
  return fmt::format("{:.3g} um seen, {:.3g} um true", 1e6 * result.measured_error_rms_m,
                     1e6 * result.error_rms_m);
}

/// What noise does to the law as printed (speeds from the readings, no leakage, no projection) and as built.
Item drift() {
  TrackingSetup setup = LinearMotor::tracking(CompensationMode::adaptive, LinearMotor::model());
  setup.noise_m = 5e-6;
  setup.duration_s = 120;
  setup.compensation.adaptive.rate[E::f] = 20;
  const TrackingResult built = track(setup);
  AdaptiveSettings& law = setup.compensation.adaptive;
  law.measured_velocity = true;
  law.speed_filter_hz = 1e6;
  law.leakage_per_s = 0;
  law.least.value.fill(-1e3);
  law.greatest.value.fill(1e3);
  const TrackingResult printed = track(setup);
  return {"Eq. (27)-(31) as printed, started right, 5 um of noise for 2 min", "",
          fmt::format("a drifts from {:.4g} to {:.4g} V s/m, f grows to {:.3g} V; error {:.3g} um rms",
                      law.initial[E::a], printed.last[E::a], printed.last[E::f], 1e6 * printed.error_rms_m),
          fmt::format("as built a stays at {:.4g}, f at {:.3g}; error {:.3g} um", built.last[E::a],
                      built.last[E::f], 1e6 * built.error_rms_m)};
}

/// Section 5: a = -10.5, b = 0.1429, f1 = 10, f2 = 10.
struct Start {
  const char* figure;
  double a, b, f1, f2;
};
constexpr double kA = -10.5, kB = 0.1429, kF1 = 10, kF2 = 10;
constexpr std::array<Start, 3> kStarts{
    {{"Fig. 8", 0, 0, 0, 0}, {"Fig. 9", -5, 0.05, 6.9979, 6.9979}, {"Fig. 10", -10, 0.1, 9.7971, 9.7971}}};

TrackingSetup start_setup(const Start& start, bool printed_f2 = false) {
  TrackingSetup setup;
  setup.truth = Model(1 / kB)
                    .set(Parameter::viscous_coefficient, (kF2 - kA) / kB)
                    .set(Parameter::coulomb_level, kF1 / kB);
  setup.gains = {0, 0, 50, false};  // all of the feedback is Eq. (25)
  setup.compensation.mode = CompensationMode::adaptive;
  setup.compensation.limit_V = setup.voltage_limit_V = 1e3;
  AdaptiveSettings& law = setup.compensation.adaptive;
  law.lambda1_per_s2 = 100;
  law.lambda2_per_s = 20;
  law.kv_per_s = 200;
  law.dead_zone_m_per_s = 1e-3;
  law.speed_filter_hz = 1000;
  law.own_feedback = true;
  law.printed_f2 = printed_f2;
  law.rate.value = {30, 0.05, 150, 30, 0};
  law.initial.value = {start.a, start.b, start.f1, start.f2, 0};
  // A feedback of nothing holds nothing: b stays above a tenth of a good start.
  law.least.value = {-100, 0.01, -100, -100, 0};
  law.greatest.value = {100, 1, 100, 100, 100};
  setup.period_s = 2e-4;
  setup.duration_s = 10;
  setup.encoder_step_m = 0;
  return setup;
}

}  // namespace

Model LinearMotor::model(double friction) {
  const double beta = 1 / inertia();
  return Model(beta)
      .set(Parameter::viscous_coefficient, beta * (kKe + kF2))
      .set(Parameter::coulomb_level, friction * beta * kF1_V);
}

TrackingSetup LinearMotor::tracking(CompensationMode mode, const Model& known) {
  TrackingSetup setup;
  setup.truth = model();
  setup.gains = {inertia() * (kLambda1 + kKv * kLambda2), inertia() * (kLambda2 + kKv), 1000, false};
  setup.voltage_limit_V = kPeakCurrent_A * kR_Ohm;
  setup.period_s = 2e-4;
  setup.duration_s = 12;
  setup.encoder_step_m = 1e-6;
  setup.compensation.mode = mode;
  setup.compensation.model = known;
  setup.compensation.limit_V = setup.voltage_limit_V;
  AdaptiveSettings law;
  law.lambda2_per_s = kLambda2;
  law.rate.value = {200, 0.02, 20, 0, 0};
  law = adaptive_about(known, law, 1, setup.voltage_limit_V);
  law.dead_zone_m_per_s = quiet_dead_zone_m_per_s(law, setup.encoder_step_m, setup.period_s);
  setup.compensation.adaptive = law;
  return setup;
}

Result<Section> adaptive_starts(const ReproduceOptions& /*options*/) {
  Section section{"Section 5: a = -10.5, b = 0.1429, f1 = f2 = 10, sine of 0.1 m and 0.5 Hz", {}};
  report::Plot plot;
  plot.title = "Error of the adaptive law from three starts";
  plot.caption = "Trajectory, gains and rates are not printed; the plot has those of this product.";
  plot.x = {"time", "s"};
  plot.y = {"error", "mm"};
  for (const Start& start : kStarts) {
    report::Series series{.name = start.figure};
    double early = 0, late = 0;
    std::size_t early_rows = 0, late_rows = 0;
    const TrackingSetup setup = start_setup(start);
    const TrackingResult result =
        track(setup, [&](double time_s, double reference_m, double reading_m, double) {
          const double e_mm = 1e3 * (reference_m - reading_m);
          if (time_s < 2) {
            early += e_mm * e_mm;
            ++early_rows;
          }
          if (time_s >= 8) {
            late += e_mm * e_mm;
            ++late_rows;
          }
          if (std::fmod(time_s, 0.02) > setup.period_s) return;
          series.x.push_back(time_s);
          series.y.push_back(e_mm);
        });
    plot.add(series);
    section.items.push_back(
        {fmt::format("{}, start a = {}, b = {}, f1 = {}, f2 = {}", start.figure, start.a, start.b, start.f1,
                     start.f2),
         &start == &kStarts[0]   ? "slow convergence, large error"
         : &start == &kStarts[1] ? "smaller error, faster"
                                 : "the best of the three",
         fmt::format("rms error {:.3g} mm in the first 2 s, {:.3g} mm in the last 2 of 10; ends at a - f2 = "
                     "{:.3g}, b = {:.3g}, f1 = {:.3g}",
                     std::sqrt(early / static_cast<double>(early_rows)),
                     std::sqrt(late / static_cast<double>(late_rows)), result.last[E::a] - result.last[E::f2],
                     result.last[E::b], result.last[E::f1]),
         fmt::format("f2 |x'| of Eq. (24), (30) is even in the direction; with x' in its place, as Eq. (13) "
                     "asks, only a - f2 has a true value: {:.1f}",
                     kA - kF2)});
  }
  const TrackingResult printed = track(start_setup(kStarts[2], true));
  section.items.push_back(
      {"the start of Fig. 10, f2 sgn(x') x' as printed", "",
       fmt::format("rms error {:.3g} mm in the last 5 of 10 s; ends at a = {:.3g}, f2 = {:.3g}, f1 = {:.3g}",
                   1e3 * printed.error_rms_m, printed.last[E::a], printed.last[E::f2], printed.last[E::f1]),
       "an even term is no friction: it pushes the same way whichever way the motor goes"});
  section.plots.push_back(std::move(plot));
  return section;
}

Result<Section> linear_motor(const ReproduceOptions& options) {
  Section section{"Section 6: linear motor of Table 1, encoder of 1 um without noise, sine of 0.5 Hz", {}};
  const double amplitude_m = published_amplitude_m();
  options.progress(0.5);
  const auto run = [&](CompensationMode mode, double friction, Trace& trace) {
    TrackingSetup setup = LinearMotor::tracking(mode, LinearMotor::model(friction));
    setup.amplitude_m = amplitude_m;
    return traced(setup, trace, 8);
  };
  Trace off, forward, adaptive;
  const TrackingResult without = run(CompensationMode::off, 1, off);
  const TrackingResult with = run(CompensationMode::feed_forward, 1, forward);
  const TrackingResult learned = run(CompensationMode::adaptive, 0, adaptive);
  section.items.push_back({"amplitude of the sine", "not printed",
                           fmt::format("{:.3g} mm", 1e3 * amplitude_m),
                           "the one at which feedback alone leaves the published error"});
  section.items.push_back({"rms tracking error without compensation",
                           fmt::format("{} um", kPublishedWithout_um), microns(without),
                           "Eq. (40) as the PD gains they amount to, 5 kHz"});
  section.items.push_back(
      {"with, the model known", fmt::format("{} um", kPublishedWith_um), microns(with),
       fmt::format("most of what is seen is the encoder's rounding; {:.0f} times smaller, published {:.1f}",
                   without.error_rms_m / with.error_rms_m, kPublishedWithout_um / kPublishedWith_um)});
  section.items.push_back(
      {"with, adaptive, from a model without friction", fmt::format("{} um", kPublishedWith_um),
       microns(learned),
       fmt::format("f1 ends at {:.4g} V (true {} V): what is left is inside the dead zone that the encoder "
                   "asks for; {:.0f} times smaller",
                   learned.last[E::f1], LinearMotor::kF1_V, without.error_rms_m / learned.error_rms_m)});
  section.items.push_back(drift());
  // The friction part by itself: the same feed-forward without it.
  Trace unused;
  const TrackingResult linear = run(CompensationMode::feed_forward, 0, unused);
  section.items.push_back({"with inertia and back-EMF compensated, friction not", "", microns(linear),
                           "what is left is friction's share"});
  report::Plot plot;
  plot.title = "Figs. 14, 15: tracking error seen by the encoder";
  plot.x = {"time", "s"};
  plot.y = {"error", "um"};
  plot.add(
      {.name = "feedback alone", .x = off.time_s, .y = off.error_um, .colour = report::Colour::reference});
  plot.add({.name = "with compensation",
            .x = forward.time_s,
            .y = forward.error_um,
            .colour = report::Colour::model});
  section.plots.push_back(std::move(plot));
  return section;
}

}  // namespace cartwright::reproduce
