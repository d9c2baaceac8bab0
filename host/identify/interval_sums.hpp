#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>

namespace cartwright {

/// One response for the double-integral form of
///
///     y'' + C(t) y' + k s = 0.
///
/// With s = y = e (the control error at constant reference) this is Eq. (60) of Wongvanich, Hann and Sirisena
/// (2015), k = beta Kp. With s = -u, the recorded voltage, k = beta and neither constant reference nor ideal
/// controller is needed (ERRATA, Sec. 2.2).
struct IntegralData {
  std::span<const double> t_s;   ///< strictly increasing
  std::span<const double> y_m;   ///< straight lines between samples
  std::span<const double> held;  ///< s, held from each sample to the next; empty: s = y
};

/// The integrals that run along an interval from its first row: I = int y, S = int s, J = int int s.
struct RunningIntegrals {
  double I = 0, S = 0, J = 0;

  /// On to `row` from the one before. Exact for y straight between samples and s held (or s = y).
  void step_to(std::size_t row, const IntegralData& data) {
    const double h = data.t_s[row] - data.t_s[row - 1];
    const double y0 = data.y_m[row - 1], y1 = data.y_m[row], before_I = I;
    I += 0.5 * h * (y0 + y1);
    if (data.held.empty()) {
      J += h * (before_I + h * (2 * y0 + y1) / 6);
      S = I;
    } else {
      const double s = data.held[row - 1];
      J += h * (S + 0.5 * h * s);
      S += h * s;
    }
  }
};

/// Normal equations of y = a + b tau - c I - k J over the rows first ... last - 1, tau from the first of
/// them, and where the integrals have got to at the last one. Without rows, nothing.
struct IntervalSums {
  Eigen::Matrix4d gram;
  Eigen::Vector4d right;
  RunningIntegrals at_end;
};

/// One pass over the samples, four runs of them side by side; no allocation. The same bits on every
/// processor.
IntervalSums interval_sums(const IntegralData& data, std::size_t first, std::size_t last);

}  // namespace cartwright
