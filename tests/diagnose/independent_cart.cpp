#include "tests/diagnose/independent_cart.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace cartwright::test {
namespace {

constexpr double kDuration_s = 4.0;
constexpr double kEulerStep_s = 2e-5;
constexpr double kDisturbanceTime_s = 0.005;

double multisine(double t_s, double least_hz, double most_hz, int tones, double amplitude) {
  double sum = 0;
  for (int i = 0; i < tones; ++i) {
    const double f = least_hz * std::pow(most_hz / least_hz, i / (tones - 1.0));
    sum += std::sin(2 * M_PI * f * t_s + 2.4 * i * i);
  }
  return amplitude * sum / std::sqrt(tones);
}

/// Moves of 0.4 s from place to place, and 0.8 s of rest after each.
double positioned(double t_s, double phase) {
  constexpr double kEvery_s = 1.2, kMove_s = 0.4;
  const auto place_m = [phase](double n) { return n == 0 ? 0 : 0.12 * std::sin(2.4 * n * n + phase); };
  const double n = std::floor(t_s / kEvery_s), s = std::min((t_s - n * kEvery_s) / kMove_s, 1.0);
  return place_m(n) + (place_m(n + 1) - place_m(n)) * s * s * s * (10 - 15 * s + 6 * s * s);
}

Recording reference(const std::string& file, const std::string& experiment, ControllerSpec controller,
                    double period_s, std::mt19937_64& random) {
  std::uniform_real_distribution<double> late(8e-6, 16e-6);
  Recording r;
  r.file = file, r.experiment = experiment, r.controller = controller;
  const double phase = file.back();  // tracks and moves differ by their letter
  for (int k = 0; k * period_s < kDuration_s; ++k) {
    const double t = k * period_s + late(random);
    r.t_s.push_back(t);
    double reference_m = 0, added_V = 0;
    if (experiment == "step") reference_m = std::fmod(t, 2.0) < 1.0 ? 0.1 : 0.0;
    if (experiment == "move") reference_m = positioned(t, phase);
    if (experiment == "track") reference_m = multisine(t + phase, 0.2, 2.5, 6, 0.06);
    if (experiment == "dither") added_V = multisine(t, 0.5, 40, 14, 2.5);
    r.r_m.push_back(reference_m);
    if (experiment == "dither") r.d_V.push_back(added_V);
  }
  return r;
}

void run(const IndependentCart& cart, const Rig& rig, Recording& r, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto* pd = std::get_if<PdGains>(&r.controller);
  const auto* relay = std::get_if<DualRelayGains>(&r.controller);
  double y = cart.start_m, v = 0, disturbance = 0, filtered = 0, previous = 0, integral = 0;
  std::vector<double> sent;
  for (std::size_t k = 0; k < r.size(); ++k) {
    const double read =
        y + cart.encoder_error_m(y) + cart.noise * cart.reading_noise_counts * cart.count_m * normal(random);
    const double measured = cart.count_m * std::round(read / cart.count_m);
    const double e = r.r_m[k] - measured;
    double u = r.added_V(k);
    if (pd) {
      if (k == 0) previous = e;
      const double share = 1 - std::exp(-2 * M_PI * pd->derivative_filter_hz * rig.period_s());
      filtered += share * ((e - previous) / rig.period_s() - filtered);
      previous = e;
      u += pd->kp_V_per_m * e + pd->kd_V_s_per_m * filtered;
    } else {
      integral += e * rig.period_s();
      u += relay->h1_V * (e >= 0 ? 1 : -1) + relay->h2_V * (integral >= 0 ? 1 : -1);
    }
    u = std::min(std::max(u, -rig.voltage_limit_V), rig.voltage_limit_V);
    r.y_m.push_back(measured);
    r.u_V.push_back(u);
    sent.push_back(u);
    if (k + 1 == r.size()) break;
    const std::size_t late = static_cast<std::size_t>(cart.delay_ticks);
    const double held = cart.amplifier(k >= late ? sent[k - late] : 0.0);
    const int steps = static_cast<int>(std::round((r.t_s[k + 1] - r.t_s[k]) / kEulerStep_s));
    const double h = (r.t_s[k + 1] - r.t_s[k]) / steps;
    const double fade = std::exp(-rig.period_s() / kDisturbanceTime_s);
    disturbance = fade * disturbance +
                  cart.noise * cart.disturbance_m_per_s2 * std::sqrt(1 - fade * fade) * normal(random);
    for (int i = 0; i < steps; ++i) {
      const double t = r.t_s[k] + i * h;
      const double level = cart.coulomb_m_per_s2 + cart.extra_level(t, y, v, held);
      const double free =
          cart.gain_m_per_s2_V * held - cart.viscous_per_s * v + cart.push(t, y, v) + disturbance;
      if (v == 0 && std::abs(free) <= level) continue;
      const double direction = v != 0 ? (v > 0 ? 1 : -1) : (free > 0 ? 1 : -1);
      const double next = v + h * (free - level * direction);
      const bool stops = level > 0 && v != 0 && next * v < 0;
      y += h * (stops ? 0.5 * v : 0.5 * (v + next));
      v = stops ? 0 : next;
    }
  }
}

}  // namespace

Session battery(const IndependentCart& cart) {
  std::mt19937_64 random(cart.seed);
  Session session;
  session.rig.encoder_resolution_m = cart.count_m;
  session.rig.sample_rate_hz = cart.sample_rate_hz;
  const PdGains step{60, 0, 50, false}, track{80, 2, 50, false}, hold{30, 1, 50, false};
  for (const auto& [file, experiment, controller] :
       {std::tuple<std::string, std::string, ControllerSpec>{"step_1.csv", "step", step},
        {"relay_a.csv", "relay", DualRelayGains{2.0, 1.5, 0}},
        {"step_2.csv", "step", step},
        {"track_a", "track", track},
        {"relay_b.csv", "relay", DualRelayGains{3.2, 2.4, 0}},
        {"dither.csv", "dither", hold},
        {"step_3.csv", "step", step},
        {"track_b", "track", track}}) {
    session.recordings.push_back(reference(file, experiment, controller, session.rig.period_s(), random));
    Recording& r = session.recordings.back();
    if (experiment == "step" && file != "step_1.csv") r.repeat_of = "step_1.csv";
    run(cart, session.rig, r, random);
  }
  return session;
}

Session moves(const IndependentCart& cart) {
  std::mt19937_64 random(cart.seed);
  Session session;
  session.rig.encoder_resolution_m = cart.count_m;
  session.rig.sample_rate_hz = cart.sample_rate_hz;
  for (const char* file : {"move_a", "move_b", "move_c", "move_d", "move_e"}) {
    session.recordings.push_back(
        reference(file, "move", PdGains{60, 1, 50, false}, session.rig.period_s(), random));
    run(cart, session.rig, session.recordings.back(), random);
  }
  return session;
}

Model nominal(double gain_m_per_s2_V, double viscous_per_s, double coulomb_m_per_s2) {
  return Model(gain_m_per_s2_V)
      .set(Parameter::viscous_coefficient, viscous_per_s)
      .set(Parameter::coulomb_level, coulomb_m_per_s2);
}

}  // namespace cartwright::test
