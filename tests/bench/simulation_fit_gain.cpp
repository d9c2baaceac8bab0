// What a fit by simulation is worth on recordings that no fit has seen, where the model lacks physics: for
// each effect left out, forty carts drawn; both forms of `identify` fit viscous and Coulomb friction and a
// constant force to four recordings; the errors after the refit over those before it, as geometric means.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "host/evaluate/evaluate.hpp"
#include "host/identify/simulation_fit.hpp"
#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr int kCarts = 40, kRecordings = 4;
constexpr double kDuration_s = 6, kTurn = 2 * std::numbers::pi;

class Draws {
 public:
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Model cart() {
    Model cart(within(1.5, 2.5));
    cart.set(P::viscous_coefficient, within(3, 7)).set(P::coulomb_level, within(0.2, 0.6));
    return cart.set(P::constant_acceleration, within(-0.1, 0.1));
  }

  Session session(const Model& cart) {
    SimulatedSession out(cart);
    for (int i = 0; i < kRecordings; ++i) {
      const double slow_m = within(0.02, 0.05), fast_m = within(0.01, 0.03);
      const double slow_hz = within(0.2, 0.7), fast_hz = within(0.7, 2.2), phase = within(0, kTurn);
      out.add(fmt::format("recording_{}.csv", i), {80, 2}, kDuration_s, [=](double t_s) {
        return slow_m * (std::sin(kTurn * slow_hz * t_s + phase) - std::sin(phase)) +
               fast_m * std::sin(kTurn * fast_hz * t_s);
      });
    }
    return out.get();
  }

 private:
  std::mt19937 random_{5};
};

/// The same references with half-second pulses of 1 V added.
Session pulsed(const Model& cart, Session session) {
  for (Recording& r : session.recordings) {
    for (const double t_s : r.t_s) r.d_V.push_back(std::fmod(t_s, 1.0) < 0.5 ? 0.0 : 1.0);
    r = simulate(cart, session.rig, r);
  }
  return session;
}

struct Errors {
  double open_loop_m, window_m;
};

Errors errors(const Model& model, const Session& session) {
  SquaredError open_loop, window;
  for (const Recording& r : session.recordings) {
    const Prediction one = predict(model, session.rig, r);
    open_loop.add(one.open_loop);
    window.add(one.window);
  }
  return {open_loop.rms_m(), window.rms_m()};
}

struct MissingPhysics {
  const char* name;
  std::vector<std::pair<P, double>> numbers;
};

const MissingPhysics kMissing[] = {
    {"nothing", {}},
    {"cable spring", {{P::spring_stiffness, 2}, {P::spring_neutral, 0}}},
    {"difference between directions", {{P::asymmetric_viscous_difference, 0.3}}},
    {"Stribeck friction", {{P::stribeck_excess, 0.15}, {P::stribeck_speed, 0.03}}},
    {"friction spot", {{P::spot_peak, 0.2}, {P::spot_centre, 0.02}, {P::spot_width, 0.01}}},
    {"exponential damping", {{P::exponential_alpha1, 5}, {P::exponential_alpha2, 20}}},
    {"quadratic drag", {{P::drag_coefficient, 8}}},
};

/// Sums of the logarithms of after over before.
struct Gain {
  double open_loop = 0, window = 0;

  void add(const Errors& after, const Errors& before) {
    open_loop += std::log(after.open_loop_m / before.open_loop_m) / kCarts;
    window += std::log(after.window_m / before.window_m) / kCarts;
  }
};

bool measure(const MissingPhysics& missing, Draws& draws) {
  const auto terms = TermSet::create({Term::viscous_friction, Term::coulomb_friction, Term::constant_force});
  Gain same, other;
  for (int i = 0; i < kCarts; ++i) {
    Model cart = draws.cart();
    for (const auto& [id, value] : missing.numbers) cart.set(id, value);
    const Session seen = draws.session(cart);
    const auto before = identify(seen, *terms);
    if (!before) return false;
    const auto after = fit_by_simulation(seen, before->model);
    if (!after) return false;
    const Session with_pulses = pulsed(cart, seen), elsewhere = draws.session(cart);
    same.add(errors(after->model, with_pulses), errors(before->model, with_pulses));
    other.add(errors(after->model, elsewhere), errors(before->model, elsewhere));
  }
  fmt::print("{:<30} {:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f}\n", missing.name, std::exp(same.open_loop),
             std::exp(other.open_loop), std::exp(same.window), std::exp(other.window));
  return true;
}

}  // namespace
}  // namespace cartwright

int main() {
  fmt::print("{:<30} {:>21} {:>21}\n{:<30} {:>10} {:>10} {:>10} {:>10}\n", "", "open loop",
             "windows of 0.5 s", "missing in the model", "same way", "other way", "same way", "other way");
  cartwright::Draws draws;
  for (const auto& missing : cartwright::kMissing) {
    if (!cartwright::measure(missing, draws)) return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
