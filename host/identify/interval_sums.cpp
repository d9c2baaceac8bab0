#include "host/identify/interval_sums.hpp"

#include "host/vector_clones.hpp"

namespace cartwright {
namespace {

/// Sums of products of (1, tau, I, J) with each other and with y: of one run of rows, or of four side by
/// side.
template <typename T>
struct Sums {
  T t{}, i{}, j{}, tt{}, ti{}, tj{}, ii{}, ij{}, jj{}, y{}, ty{}, iy{}, jy{};

  /// always_inline: the callers are compiled for several processors, and this with them.
  [[gnu::always_inline]] void add(const T& tau, const T& I, const T& J, const T& value) {
    t += tau;
    i += I;
    j += J;
    tt += tau * tau;
    ti += tau * I;
    tj += tau * J;
    ii += I * I;
    ij += I * J;
    jj += J * J;
    y += value;
    ty += tau * value;
    iy += I * value;
    jy += J * value;
  }
};

/// Four runs of rows, one after another in time, one in each lane; every run integrates from its own start.
struct FourRuns {
  Sums<Lanes> sums;
  Lanes I{}, S{}, J{};  ///< at the end of each run
};

/// The four runs put together, as if integrated from the start of the first: I + I0, and
/// J + J0 + S0 (tau - tau0) = J + S0 tau + K0, with I0, S0, J0 at the start tau0 of a run.
[[gnu::always_inline]] inline Sums<double> together(const FourRuns& runs, const double* t_s,
                                                    std::size_t length, double from_s,
                                                    RunningIntegrals& end) {
  Lanes I0, S0, K0;
#pragma GCC unroll 4
  for (std::size_t run = 0; run < kLanes; ++run) {
    const double start_s = t_s[run * length] - from_s, end_s = t_s[(run + 1) * length] - from_s;
    I0[run] = end.I;
    S0[run] = end.S;
    K0[run] = end.J - end.S * start_s;
    end.J += end.S * (end_s - start_s) + runs.J[run];
    end.I += runs.I[run];
    end.S += runs.S[run];
  }
  const Sums<Lanes>& s = runs.sums;
  const double n = static_cast<double>(length);
  const Lanes j = s.j + S0 * s.t + n * K0;
  Sums<double> out;
  out.t = total(s.t);
  out.tt = total(s.tt);
  out.y = total(s.y);
  out.ty = total(s.ty);
  out.i = total(s.i + n * I0);
  out.j = total(j);
  out.ti = total(s.ti + I0 * s.t);
  out.tj = total(s.tj + S0 * s.tt + K0 * s.t);
  out.ii = total(s.ii + I0 * (2 * s.i + n * I0));
  out.ij = total(s.ij + S0 * s.ti + K0 * s.i + I0 * j);
  out.jj = total(s.jj + S0 * (2 * s.tj + S0 * s.tt) + K0 * (s.j + j + S0 * s.t));
  out.iy = total(s.iy + I0 * s.y);
  out.jy = total(s.jy + S0 * s.ty + K0 * s.y);
  return out;
}

/// The sums over 4 times `length` rows, the arrays starting at the row before; `end` runs along.
CARTWRIGHT_VECTOR_CLONES Sums<double> integrate(const double* t_s, const double* y_m, const double* held,
                                                std::size_t length, double from_s, RunningIntegrals& end) {
  // Lane by lane: a vector as the result of a function would change how functions are called.
#define CARTWRIGHT_OF_EACH_RUN(a, n) \
  Lanes{(a)[n], (a)[(n) + length], (a)[(n) + 2 * length], (a)[(n) + 3 * length]}
  FourRuns runs;
  Lanes t0 = CARTWRIGHT_OF_EACH_RUN(t_s, 0), y0 = CARTWRIGHT_OF_EACH_RUN(y_m, 0);
  for (std::size_t n = 1; n <= length; ++n) {
    const Lanes t1 = CARTWRIGHT_OF_EACH_RUN(t_s, n), y1 = CARTWRIGHT_OF_EACH_RUN(y_m, n);
    const Lanes h = t1 - t0, half_h = 0.5 * h, both = y0 + y1;
    if (held == nullptr) {
      runs.J += h * (runs.I + (1.0 / 6) * h * (both + y0));
    } else {
      const Lanes s = CARTWRIGHT_OF_EACH_RUN(held, n - 1);
      runs.J += h * (runs.S + half_h * s);
      runs.S += h * s;
    }
    runs.I += half_h * both;
    runs.sums.add(t1 - from_s, runs.I, runs.J, y1);
    t0 = t1;
    y0 = y1;
  }
#undef CARTWRIGHT_OF_EACH_RUN
  if (held == nullptr) runs.S = runs.I;
  return together(runs, t_s, length, from_s, end);
}

}  // namespace

IntervalSums interval_sums(const IntegralData& data, std::size_t first, std::size_t last) {
  IntervalSums out;
  if (first >= last) {
    out.gram.setZero();
    out.right.setZero();
    return out;
  }
  Sums<double> s;
  RunningIntegrals& r = out.at_end;
  const double from_s = data.t_s[first];
  const std::size_t length = (last - first - 1) / kLanes;
  if (length > 0) {
    s = integrate(&data.t_s[first], &data.y_m[first], data.held.empty() ? nullptr : &data.held[first], length,
                  from_s, r);
  }
  s.y += data.y_m[first];  // where tau, I and J are nothing
  for (std::size_t row = first + kLanes * length + 1; row < last; ++row) {
    r.step_to(row, data);
    s.add(data.t_s[row] - from_s, r.I, r.J, data.y_m[row]);
  }
  if (last < data.t_s.size()) r.step_to(last, data);
  const double n = static_cast<double>(last - first);
  out.gram << n, s.t, -s.i, -s.j,  //
      s.t, s.tt, -s.ti, -s.tj,     //
      -s.i, -s.ti, s.ii, s.ij,     //
      -s.j, -s.tj, s.ij, s.jj;
  out.right << s.y, s.ty, -s.iy, -s.jy;
  return out;
}

}  // namespace cartwright
