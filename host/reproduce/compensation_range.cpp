#include "host/reproduce/compensation_range.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "host/reproduce/linear_motor.hpp"

namespace cartwright::reproduce {
namespace {

using E = AdaptiveEstimates;

Model cart(double friction = 1) {
  return Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5 * friction);
}

TrackingSetup cart_tracking(CompensationMode mode, const Model& known) {
  TrackingSetup setup;
  setup.truth = cart();
  setup.compensation.mode = mode;
  setup.compensation.model = known;
  AdaptiveSettings law;
  law.rate.value = {20, 1, 5, 0, 0};
  setup.compensation.adaptive = adaptive_about(known, law, 1, setup.voltage_limit_V);
  return setup;
}

TrackingSetup motor_tracking(CompensationMode mode, const Model& known) {
  return LinearMotor::tracking(mode, known);
}

struct Machine {
  const char* name;
  TrackingSetup (*setup)(CompensationMode, const Model&);
  Model truth, short_of_friction;
  double own_step_m;
  std::array<double, 5> steps_m;
  std::array<double, 3> noises_m;
};

/// The dead zone has to hold what readings do by themselves: rounding, and noise at three times its deviation
/// where that is more.
TrackingSetup measured_by(TrackingSetup setup, double step_m, double noise_m) {
  setup.encoder_step_m = step_m;
  setup.noise_m = noise_m;
  AdaptiveSettings& law = setup.compensation.adaptive;
  law.dead_zone_m_per_s = quiet_dead_zone_m_per_s(law, std::max(step_m, 3 * noise_m), setup.period_s);
  return setup;
}

double error_m(const Machine& machine, CompensationMode mode, const Model& known, double step_m,
               double noise_m) {
  return track(measured_by(machine.setup(mode, known), step_m, noise_m)).error_rms_m;
}

void add_machine(Section& section, const Machine& machine, const std::function<void()>& done) {
  using M = CompensationMode;
  report::Plot plot;
  plot.title = fmt::format("{}: error without compensation over error with it", machine.name);
  plot.caption = "Feed-forward of the true model, solid; adaptive from 20 % too little friction, dashed.";
  plot.x = {.label = "encoder step", .unit = "um", .logarithmic = true};
  plot.y = {.label = "factor", .logarithmic = true};
  plot.guides.push_back({report::Guide::Along::y, 11, "11"});
  report::Table table;
  table.caption = fmt::format("{}: how many times smaller the error is", machine.name);
  table.columns = {{"Noise", "um"},
                   {"Encoder step", "um"},
                   {"Without", "um"},
                   {"Feed-forward, true"},
                   {"Adaptive, 20 % off"}};
  for (const double noise_m : machine.noises_m) {
    report::Series forward{.name = fmt::format("noise {:g} um", 1e6 * noise_m)};
    report::Series adaptive{.name = fmt::format("adaptive, noise {:g} um", 1e6 * noise_m), .dashed = true};
    for (const double step_m : machine.steps_m) {
      const double without = error_m(machine, M::off, machine.truth, step_m, noise_m);
      forward.x.push_back(1e6 * step_m);
      adaptive.x.push_back(1e6 * step_m);
      forward.y.push_back(without / error_m(machine, M::feed_forward, machine.truth, step_m, noise_m));
      adaptive.y.push_back(without /
                           error_m(machine, M::adaptive, machine.short_of_friction, step_m, noise_m));
      const auto number = [](double value) { return report::Cell::number(value, 3); };
      table.row({number(1e6 * noise_m), number(1e6 * step_m), number(1e6 * without), number(forward.y.back()),
                 number(adaptive.y.back())});
      if (noise_m == 0 && step_m == machine.own_step_m) {
        section.items.push_back(
            {fmt::format("{}, 0.5 Hz, its own encoder of {:g} um without noise: error without over with",
                         machine.name, 1e6 * step_m),
             "11.2/1.01 = 11.1 (Section 6)",
             fmt::format("{:.0f} feed-forward of the true model, {:.0f} adaptive", forward.y.back(),
                         adaptive.y.back()),
             fmt::format("{:.3g} um rms without; adaptive from 20 % too little friction. The model is the "
                         "plant's own here and the measured motor's in the paper, with all it leaves out",
                         1e6 * without)});
      }
      done();
    }
    plot.add(std::move(forward));
    plot.add(std::move(adaptive));
  }
  section.tables.push_back(std::move(table));
  section.plots.push_back(std::move(plot));
}

void add_hour(Section& section) {
  TrackingSetup setup = measured_by(cart_tracking(CompensationMode::adaptive, cart()), 2.275e-5, 1e-5);
  setup.duration_s = 3600;
  setup.change_s = 1800;
  setup.later = cart(1.5);
  const auto start = std::chrono::steady_clock::now();
  const TrackingResult with = track(setup);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  setup.compensation.mode = CompensationMode::off;
  const TrackingResult without = track(setup);
  const auto range = [&](E::Index i) {
    return fmt::format("[{:.4g}, {:.4g}]", with.least[i], with.greatest[i]);
  };
  section.items.push_back(
      {"one hour at 1 kHz, encoder 22.75 um, noise 10 um, friction half as large again after 30 min", "",
       fmt::format("estimates stay in a {}, b {}, f1 {}; f1 ends at {:.4g} V (true {:.4g} V)", range(E::a),
                   range(E::b), range(E::f1), with.last[E::f1], 1.5 * 0.5 / 1.9),
       fmt::format("limits met: {}; simulated {:.0f} times faster than real time",
                   with.limits_met == 0 ? "none" : fmt::format("bits {}", with.limits_met), 3600 / took_s)});
  section.items.push_back(
      {"the same hour, chatter", "",
       fmt::format("the voltage moves by {:.1f} V/s with, {:.1f} V/s without compensation",
                   with.variation_V_per_s, without.variation_V_per_s),
       fmt::format("error over the last half {:.0f} times smaller", without.error_rms_m / with.error_rms_m)});
}

/// The proof of the adaptive law is for PD; this is what an integral beside it does.
void add_integral(Section& section) {
  const TrackingSetup plain = cart_tracking(CompensationMode::adaptive, cart(0.8));
  const double beta = cart()[Parameter::voltage_gain], c = cart()[Parameter::viscous_coefficient];
  // Routh's criterion of s^3 + (c + beta Kd) s^2 + beta Kp s + beta Ki.
  const double most = (c + beta * plain.gains.kd_V_s_per_m) * plain.gains.kp_V_per_m;
  std::string text;
  for (const double part : {0.0, 0.1, 0.3, 0.6}) {
    TrackingSetup setup = measured_by(plain, 2.275e-5, 1e-5);
    setup.ki_V_per_m_s = part * most;
    setup.duration_s = 600;
    const TrackingResult with = track(setup);
    setup.compensation.mode = CompensationMode::off;
    const double without_m = track(setup).error_rms_m;
    text += fmt::format("{}Ki {:.0f}: {:.3g} um with, {:.3g} without, f1 in [{:.3g}, {:.3g}]",
                        text.empty() ? "" : "; ", setup.ki_V_per_m_s, 1e6 * with.error_rms_m, 1e6 * without_m,
                        with.least[E::f1], with.greatest[E::f1]);
  }
  section.items.push_back(
      {"cart under PID, adaptive from 20 % too little friction, 10 min, encoder 22.75 um, noise 10 um", "",
       text,
       fmt::format("the proof is for PD; Kp {:g}, Kd {:g} alone are stable up to Ki {:.0f} V/(m s)",
                   plain.gains.kp_V_per_m, plain.gains.kd_V_s_per_m, most)});
}

}  // namespace

Result<Section> compensation_range(const ReproduceOptions& options) {
  Section section{"Friction compensation over encoder step, noise and time", {}};
  const std::array<Machine, 2> machines{{{"cart",
                                          cart_tracking,
                                          cart(),
                                          cart(0.8),
                                          2.275e-5,
                                          {1e-6, 5e-6, 2.275e-5, 5e-5, 1e-4},
                                          {0, 1e-5, 5e-5}},
                                         {"linear motor",
                                          motor_tracking,
                                          LinearMotor::model(),
                                          LinearMotor::model(0.8),
                                          1e-6,
                                          {1e-7, 5e-7, 1e-6, 5e-6, 2e-5},
                                          {0, 1e-6, 5e-6}}}};
  int runs = 0;
  const auto done = [&] { options.progress(++runs / 32.0); };
  for (const Machine& machine : machines) add_machine(section, machine, done);
  add_integral(section);
  add_hour(section);
  options.progress(1);
  return section;
}

}  // namespace cartwright::reproduce
