#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/regression/dormand_prince.hpp"
#include "host/regression/regression.hpp"

namespace cartwright {

/// The response of e'' + c_i e' + k e = 0 at every sample, written once for numbers and for numbers that
/// carry derivatives. Intervals start where those of the integral method do.
template <typename T>
struct PiecewiseResponse {
  RegressionData data;
  std::size_t intervals;
  const T* damping;
  T stiffness;

  /// Calls visit(row, e).
  template <typename Visit>
  void analytical(T e, T v, Visit&& visit) const {
    std::size_t row = 0;
    for (std::size_t i = 0; i < intervals; ++i) {
      const Motion motion(damping[i], stiffness, e, v);
      const double from_s = boundary_s(i), to_s = boundary_s(i + 1);
      for (; row < data.t_s.size() && (data.t_s[row] < to_s || i + 1 == intervals); ++row)
        visit(row, motion.at(data.t_s[row] - from_s));
      v = motion.velocity_at(to_s - from_s);
      e = motion.at(to_s - from_s);
    }
  }

  /// Classical Runge-Kutta, one step per sample; an interval's end inside a step splits it.
  template <typename Visit>
  void integrated(T e, T v, Visit&& visit) const {
    std::size_t i = 0;
    visit(0, e);
    for (std::size_t row = 1; row < data.t_s.size(); ++row) {
      double from_s = data.t_s[row - 1];
      while (i + 1 < intervals && boundary_s(i + 1) <= data.t_s[row]) {
        step(boundary_s(i + 1) - from_s, damping[i], e, v);
        from_s = boundary_s(++i);
      }
      step(data.t_s[row] - from_s, damping[i], e, v);
      visit(row, e);
    }
  }

  /// Adaptive steps of Dormand and Prince; numbers only. NaN where it takes too many.
  template <typename Visit>
  void adaptive(T e, T v, Visit&& visit) const {
    constexpr double kRelative = 1e-6, kAbsolute = 1e-9;
    std::array<double, 2> state{e, v};
    double step_s = 1e-3;
    std::size_t row = 0;
    for (std::size_t i = 0; i < intervals; ++i) {
      const auto acceleration = [c = damping[i], k = stiffness](double y, double speed) {
        return -c * speed - k * y;
      };
      const double from_s = boundary_s(i), to_s = boundary_s(i + 1);
      const DormandPrince solver(acceleration, kRelative, kAbsolute);
      const bool reached = solver.run(state, to_s - from_s, step_s, [&](double, double until, auto&& at) {
        for (; row < data.t_s.size() && data.t_s[row] - from_s <= until + 1e-12; ++row)
          visit(row, at(data.t_s[row] - from_s));
      });
      if (!reached) break;
    }
    for (; row < data.t_s.size(); ++row) visit(row, std::numeric_limits<double>::quiet_NaN());
  }

 private:
  double boundary_s(std::size_t i) const {
    const double length_s = data.t_s.back() - data.t_s.front();
    return data.t_s.front() + length_s * static_cast<double>(i) / static_cast<double>(intervals);
  }

  /// Eq. (91) from the start of an interval, for damping below and above critical.
  struct Motion {
    T c, k, e0, v0, root;
    bool oscillates;

    Motion(const T& c_, const T& k_, const T& e_, const T& v_) : c(c_), k(k_), e0(e_), v0(v_) {
      using std::sqrt;
      const T square = 4.0 * k - c * c;
      oscillates = square > T(0);
      const T size = oscillates ? square : T(-square);
      root = sqrt(size > T(1e-12) ? size : T(1e-12));
    }
    void parts(double tau, T& cosine, T& sine_over_root) const {
      using std::cos;
      using std::cosh;
      using std::exp;
      using std::sin;
      using std::sinh;
      const T half = 0.5 * root * tau, decay = exp(-0.5 * tau * c);
      cosine = decay * (oscillates ? cos(half) : cosh(half));
      sine_over_root = decay * (oscillates ? sin(half) : sinh(half)) / root;
    }
    T at(double tau) const {
      T cosine, sine;
      parts(tau, cosine, sine);
      return e0 * cosine + (2.0 * v0 + c * e0) * sine;
    }
    T velocity_at(double tau) const {
      T cosine, sine;
      parts(tau, cosine, sine);
      return v0 * cosine - (2.0 * k * e0 + c * v0) * sine;
    }
  };

  void step(double h, const T& c, T& e, T& v) const {
    if (!(h > 0)) return;
    const T a1 = -c * v - stiffness * e;
    const T v2 = v + 0.5 * h * a1;
    const T a2 = -c * v2 - stiffness * (e + 0.5 * h * v);
    const T v3 = v + 0.5 * h * a2;
    const T a3 = -c * v3 - stiffness * (e + 0.5 * h * v2);
    const T v4 = v + h * a3;
    const T a4 = -c * v4 - stiffness * (e + h * v3);
    e += h / 6 * (v + 2.0 * (v2 + v3) + v4);
    v += h / 6 * (a1 + 2.0 * (a2 + a3) + a4);
  }
};

}  // namespace cartwright
