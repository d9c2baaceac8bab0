#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace cartwright {

/// The embedded Runge-Kutta pair of orders 5 and 4 of Dormand and Prince (1980), the method of MATLAB's
/// ode45: steps as long as the error allows, values in between from the free interpolant of Shampine (Hairer,
/// Norsett, Wanner, "Solving ordinary differential equations I", II.6). For y'' = f(y, y').
template <typename Acceleration>
class DormandPrince {
 public:
  using State = std::array<double, 2>;  ///< y, y'

  DormandPrince(Acceleration acceleration, double relative, double absolute)
      : acceleration_(acceleration), relative_(relative), absolute_(absolute) {}

  /// False where it takes more steps than any useful response does (stiff: damping of thousands a second).
  /// From `state` at 0 to `end`; calls visit(from, to, at), at(t) giving y inside the step.
  template <typename Visit>
  bool run(State& state, double end, double& step, Visit&& visit) const {
    constexpr int kMostSteps = 2000;
    double t = 0;
    State k1 = rate(state);
    for (int tries = 0; t < end; ++tries) {
      if (tries > kMostSteps || !std::isfinite(state[0])) return false;
      const double h = std::min(step, end - t);
      const Stages s = stages(state, k1, h);
      if (!(s.error <= 1)) {
        step = h * std::max(0.2, std::isfinite(s.error) ? 0.9 * std::pow(s.error, -0.2) : 0.2);
        continue;
      }
      visit(t, t + h, [&](double at) { return between(state[0], s, h, (at - t) / h); });
      t = end - t <= h ? end : t + h;
      state = s.end;
      k1 = s.k[6];
      step = std::max(step, h) * std::min(5.0, 0.9 * std::pow(std::max(s.error, 1e-10), -0.2));
    }
    return true;
  }

 private:
  struct Stages {
    std::array<State, 7> k;
    State end;
    double error = 0;  ///< one: as much as allowed
  };

  State rate(const State& s) const { return {s[1], acceleration_(s[0], s[1])}; }

  Stages stages(const State& s, const State& k1, double h) const {
    static constexpr double a[6][6] = {
        {1.0 / 5},
        {3.0 / 40, 9.0 / 40},
        {44.0 / 45, -56.0 / 15, 32.0 / 9},
        {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
        {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
        {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    static constexpr double e[7] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                    -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    Stages out;
    out.k[0] = k1;
    for (std::size_t i = 0; i < 6; ++i) {
      State at = s;
      for (std::size_t j = 0; j <= i; ++j) {
        at[0] += h * a[i][j] * out.k[j][0];
        at[1] += h * a[i][j] * out.k[j][1];
      }
      out.k[i + 1] = rate(at);
      out.end = at;  // the last stage is the solution
    }
    for (std::size_t n = 0; n < 2; ++n) {
      double wrong = 0;
      for (std::size_t j = 0; j < 7; ++j) wrong += h * e[j] * out.k[j][n];
      const double allowed = std::max(absolute_, relative_ * std::max(std::abs(s[n]), std::abs(out.end[n])));
      out.error = std::max(out.error, std::abs(wrong) / allowed);
      if (!std::isfinite(wrong)) out.error = wrong;
    }
    return out;
  }

  static double between(double start, const Stages& s, double h, double part) {
    static constexpr double d[7] = {-12715105075.0 / 11282082432,  0,
                                    87487479700.0 / 32700410799,   -10690763975.0 / 1880347072,
                                    701980252875.0 / 199316789632, -1453857185.0 / 822651844,
                                    69997945.0 / 29380423};
    double fourth = 0;
    for (std::size_t j = 0; j < 7; ++j) fourth += h * d[j] * s.k[j][0];
    const double change = s.end[0] - start, rise = h * s.k[0][0] - change;
    const double rest = change - h * s.k[6][0] - rise, left = 1 - part;
    return start + part * (change + left * (rise + part * (rest + left * fourth)));
  }

  Acceleration acceleration_;
  double relative_, absolute_;
};

}  // namespace cartwright
