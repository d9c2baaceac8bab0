#include "tests/blind/battery.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace cartwright::blind {
namespace {

/// A sum of tones with random phases, of the given greatest amplitude, roughly.
class Multisine {
 public:
  Multisine(double least_hz, double most_hz, int tones, double amplitude, std::mt19937_64& random)
      : amplitude_(amplitude / std::sqrt(tones)) {
    std::uniform_real_distribution<double> turn(0, 2 * M_PI);
    for (int i = 0; i < tones; ++i)
      tones_.push_back({least_hz * std::pow(most_hz / least_hz, i / (tones - 1.0)), turn(random)});
  }
  double operator()(double t_s) const {
    double sum = 0;
    for (const auto& [f_hz, phase] : tones_) sum += std::sin(2 * M_PI * f_hz * t_s + phase);
    return amplitude_ * sum;
  }

 private:
  double amplitude_;
  std::vector<std::pair<double, double>> tones_;
};

/// Slow traverses both ways, each pair faster than the last.
double sweep_m(double t_s) {
  double begun = 0;
  for (const double speed : {0.08, 0.12, 0.2, 0.3, 0.3, 0.3}) {
    const double leg = 0.12 / speed;
    if (t_s < begun + 2 * leg) {
      const double into = (t_s - begun) / leg;
      return into < 1 ? -0.06 + 0.12 * into : 0.18 - 0.12 * into;
    }
    begun += 2 * leg;
  }
  return -0.06;
}

/// The PD and dual-relay laws as the contract states them, written once more.
class Controller {
 public:
  Controller(const ControllerSpec& spec, double period_s) : spec_(spec), period_s_(period_s) {}
  double operator()(double e) {
    if (const auto* pd = std::get_if<PdGains>(&spec_)) {
      if (first_) previous_ = e;
      first_ = false;
      const double share = 1 - std::exp(-2 * M_PI * pd->derivative_filter_hz * period_s_);
      filtered_ += share * ((e - previous_) / period_s_ - filtered_);
      previous_ = e;
      return pd->kp_V_per_m * e + pd->kd_V_s_per_m * filtered_;
    }
    const auto& relay = std::get<DualRelayGains>(spec_);
    integral_ += e * period_s_;
    return relay.h1_V * (e >= 0 ? 1 : -1) + relay.h2_V * (integral_ >= 0 ? 1 : -1);
  }

 private:
  const ControllerSpec& spec_;
  double period_s_;
  bool first_ = true;
  double previous_ = 0, filtered_ = 0, integral_ = 0;
};

Recording run(const CartPhysics& physics, const Rig& rig, Recording r, int index, double duration_s,
              const std::function<double(double)>& reference, const std::function<double(double)>& added,
              std::mt19937_64& random) {
  const double period_s = rig.period_s();
  std::exponential_distribution<double> late(1 / 6e-6);
  std::uniform_real_distribution<double> uniform;
  const auto rows = static_cast<std::size_t>(std::lround(duration_s / period_s));
  for (std::size_t k = 0; k <= rows; ++k) {
    const double more = uniform(random) < 0.003 ? 1.2e-4 * uniform(random) : 0;
    r.t_s.push_back(static_cast<double>(k) * period_s + 4e-6 + std::min(late(random), 5e-5) + more);
  }
  Cart cart(physics, index, random());
  Controller controller(r.controller, period_s);
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = r.t_s[k], y = cart.read();
    r.r_m.push_back(reference(t));
    if (added) r.d_V.push_back(added(t));
    const double u = controller(r.r_m[k] - y) + (added ? r.d_V[k] : 0);
    r.y_m.push_back(y);
    r.u_V.push_back(std::clamp(u, -rig.voltage_limit_V, rig.voltage_limit_V));
    cart.hold(r.u_V[k], t, r.t_s[k + 1] - t);
  }
  r.t_s.pop_back();
  return r;
}

}  // namespace

Session battery(const CartPhysics& physics, std::uint64_t seed, double sample_rate_hz) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  Session session;
  session.rig.name = "concealed";
  session.rig.encoder_resolution_m = physics.count_m;
  session.rig.sample_rate_hz = sample_rate_hz;
  const auto add = [&](const char* file, const char* experiment, ControllerSpec controller, double duration_s,
                       const std::function<double(double)>& reference,
                       const std::function<double(double)>& added = {}) {
    Recording r;
    r.file = file, r.experiment = experiment, r.controller = controller;
    if (r.file == "step_kp60_2.csv" || r.file == "step_kp60_3.csv") r.repeat_of = "step_kp60_1.csv";
    const int index = static_cast<int>(session.recordings.size());
    session.recordings.push_back(
        run(physics, session.rig, std::move(r), index, duration_s, reference, added, random));
  };
  const PdGains soft{60, 0, 50, false}, firm{80, 3, 50, false}, track_a{80, 2, 50, false},
      track_b{60, 1, 50, false}, traverse{100, 2, 50, false}, hold{30, 1, 50, false};
  const double height = 0.08 + 0.04 * uniform(random);
  const auto steps = [height](double t) { return std::fmod(t, 2.0) < 1.0 ? height : 0.0; };
  const double h1 = 1.8 + 0.4 * uniform(random), more = 1.5 + 0.4 * uniform(random);
  const DualRelayGains relay_a{h1, 0.75 * h1, 0}, relay_b{more * h1, 0.72 * more * h1, 0};
  const Multisine a(0.2, 2.5, 7, 0.07, random), b(0.15, 3, 8, 0.08, random), dither(0.5, 45, 16, 3, random);
  const auto zero = [](double) { return 0.0; };
  add("step_kp60_1.csv", "step", soft, 6, steps);
  add("step_kp80_kd3.csv", "step", firm, 6, steps);
  add("relay_a.csv", "relay", relay_a, 6, zero);
  add("relay_b.csv", "relay", relay_b, 6, zero);
  add("step_kp60_2.csv", "step", soft, 6, steps);
  add("track_a.csv", "track", track_a, 8, a);
  add("sweep.csv", "sweep", traverse, 8, sweep_m);
  add("dither_a.csv", "dither", hold, 8, zero, dither);
  add("track_b.csv", "track", track_b, 8, b);
  add("step_kp60_3.csv", "step", soft, 6, steps);
  return session;
}

Session unseen_track(const CartPhysics& physics, std::uint64_t seed, double sample_rate_hz) {
  std::mt19937_64 random(seed);
  Session session;
  session.rig.name = "concealed";
  session.rig.encoder_resolution_m = physics.count_m;
  session.rig.sample_rate_hz = sample_rate_hz;
  Recording r;
  r.file = "track_c.csv", r.experiment = "track", r.controller = PdGains{70, 1.5, 50, false};
  const Multisine reference(0.2, 2.8, 7, 0.075, random);
  session.recordings.push_back(run(physics, session.rig, std::move(r), 99, 8, reference, {}, random));
  return session;
}

}  // namespace cartwright::blind
