#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/design/tuning_rules.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/relay/limit_cycle.hpp"

namespace cartwright::design {
namespace {

constexpr double kMargin_deg = 60;

/// Speeds of the step: damping that depends on speed counts with its value there.
double mean_speed_m_per_s(const Trials& trials) {
  const auto& settles_s = trials.specification[Quantity::settling_time];
  return std::abs(trials.step.step_m) / settles_s.value_or(0.25 * trials.step.duration_s);
}

SimpleCart simple_cart(const Model& m, const Trials& trials) {
  const auto present = [&m](Parameter p) {
    const auto term = info(p).term;
    return term && !m.has(*term) ? 0.0 : m[p];
  };
  const double v = mean_speed_m_per_s(trials);
  return {m[Parameter::voltage_gain],
          present(Parameter::viscous_coefficient) + present(Parameter::exponential_gamma) +
              present(Parameter::exponential_alpha1) * std::exp(-present(Parameter::exponential_alpha2) * v) +
              present(Parameter::drag_coefficient) * v,
          0.5 * trials.loop.period_s + present(Parameter::transport_delay) +
              present(Parameter::armature_time_constant)};
}

/// Volts that only just move the cart.
double breakaway_V(const Model& m) {
  double level = 0;
  const auto add = [&](Parameter p) {
    if (m.has(*info(p).term)) level += std::abs(m[p]);
  };
  for (const Parameter p : {Parameter::coulomb_level, Parameter::stribeck_excess, Parameter::spot_peak,
                            Parameter::constant_acceleration}) {
    add(p);
  }
  for (const PeriodicTerm& wave : kCoggingWaves) add(wave.amplitude);
  return level / m[Parameter::voltage_gain] +
         (m.has(Term::input_dead_zone) ? m[Parameter::dead_zone_half_width] : 0);
}

class Comparison {
 public:
  Comparison(const Trials& trials, bool integral) : trials_(trials), integral_(integral) {}

  void add(std::string name, std::string from, const Gains& gains) {
    TuningRule rule{std::move(name), std::move(from), gains, {}, false, false};
    rule.metrics = trials_.metrics(trials_.scenarios.front(), gains);
    rule.meets = judge(trials_.specification, rule.metrics).met();
    rule.holds = rule.meets && trials_.all_meet(gains);
    out_.rules.push_back(std::move(rule));
  }

  /// What a cart of two numbers and a dead time gives.
  void add_cart_rules(const SimpleCart& cart, const std::string& from) {
    add("critically damped", from,
        critically_damped(
            cart, natural_frequency_for(trials_.specification, trials_.loop, trials_.step, cart), integral_));
    const auto ultimate = ultimate_point(cart);
    if (!ultimate) {
      out_.remarks.push_back(
          fmt::format("{}: no ultimate gain, the cart has no damping or the loop no dead time", from));
      return;
    }
    const std::string point =
        fmt::format("{}: Ku = {:.4g} V/m, Tu = {:.3g} s", from, ultimate->gain_V_per_m, ultimate->period_s);
    add("Ziegler-Nichols", point, ziegler_nichols(*ultimate, integral_));
    add("Tyreus-Luyben", point, tyreus_luyben(*ultimate, integral_));
  }

  /// Each limit cycle by itself, then all together by the describing function.
  void add_relay_rules(const Session& session, const std::string& source) {
    std::vector<RelayFeature> features;
    for (const Recording& recording : session.recordings) {
      const auto* gains = std::get_if<DualRelayGains>(&recording.controller);
      if (!gains) continue;
      const auto cycle = find_limit_cycle(recording, session.rig);
      if (!cycle) {
        out_.remarks.push_back(
            fmt::format("{} {}: refused: {}", source, recording.file, cycle.error().message));
        continue;
      }
      const double frequency_hz = cycle->sine.frequency_hz.value;
      features.push_back(
          {gains->h1_V, gains->h2_V, cycle->sine.amplitude.value, 2 * std::numbers::pi * frequency_hz});
      add(fmt::format("phase margin {:.0f}°", kMargin_deg),
          fmt::format("{} {}: {:.3g} mm at {:.3g} Hz", source, recording.file,
                      1e3 * features.back().amplitude_m, frequency_hz),
          phase_margin_gains(features.back(), kMargin_deg * std::numbers::pi / 180, integral_));
    }
    const auto found = corrected_describing_function(features);
    if (!found) {
      out_.remarks.push_back(source +
                             ": no gain and damping by the describing function: " + found.error().message);
      return;
    }
    add_cart_rules(
        {1 / found->tp_over_kp, found->inverse_kp_plus_f2 / found->tp_over_kp, 0.5 * trials_.loop.period_s},
        source + ", describing function");
  }

  RuleComparison take() { return std::move(out_); }

 private:
  const Trials& trials_;
  bool integral_;
  RuleComparison out_;
};

}  // namespace

Session simulated_relay_session(const Model& model, const Loop& loop) {
  constexpr double kDuration_s = 20;
  Session session;
  session.rig.sample_rate_hz = 1 / loop.period_s;
  session.rig.encoder_resolution_m = loop.encoder_resolution_m;
  session.rig.voltage_limit_V = loop.voltage_limit_V;
  const auto rows = static_cast<std::size_t>(kDuration_s / loop.period_s);
  for (const double part : {0.1, 0.15, 0.2}) {
    // The slower relay must move the cart by itself: h2 > f1.
    const double h1_V = part * loop.voltage_limit_V + breakaway_V(model);
    const double h2_V = 0.5 * part * loop.voltage_limit_V + breakaway_V(model);
    Recording recording;
    recording.file = fmt::format("relay_{:.3g}V", h1_V);
    recording.experiment = "relay";
    recording.controller = DualRelayGains{h1_V, h2_V};
    for (std::size_t k = 0; k < rows; ++k) recording.t_s.push_back(static_cast<double>(k) * loop.period_s);
    recording.y_m = recording.u_V = recording.r_m = std::vector<double>(rows, 0);
    session.recordings.push_back(simulate(model, session.rig, recording));
  }
  return session;
}

RuleComparison compare_rules(const Trials& trials, const Session& relay_session, bool simulated,
                             bool integral) {
  Comparison comparison(trials, integral);
  comparison.add_cart_rules(simple_cart(trials.scenarios.front().model, trials), "model");
  comparison.add_relay_rules(relay_session, simulated ? "simulated relay" : "relay");
  return comparison.take();
}

}  // namespace cartwright::design
