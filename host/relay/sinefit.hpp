#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/result.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

struct SineFitOptions {
  std::optional<double>
      frequency_hz;   ///< known frequency: the other values are then a linear problem ("sinefit2")
  int harmonics = 1;  ///< 1 is the sine alone; up to 20
};

struct SineHarmonic {
  int order = 2;
  Estimate amplitude, phase_rad;
};

/// y = offset + trend (t - t_mid) + A sin(2 pi f t + phase) + sum over k of A_k sin(2 pi k f t + phase_k),
/// A > 0, phase in (-pi, pi] at t = 0 of the data's own clock.
struct SineFit {
  Estimate amplitude, frequency_hz, phase_rad, offset;
  double rms = 0;                       ///< of what is left
  std::optional<Estimate> trend_per_s;  ///< where the data shows one; `offset` is then the value at t_mid
  double middle_s = 0;                  ///< t_mid: the middle of the record
  std::vector<SineHarmonic> harmonics;  ///< orders 2 ... on request
  double periods = 0;                   ///< in the record
  std::vector<double> residual;

  double at(double t_s) const;
};

/// Least-squares sine fit to samples at their own times, however they jitter.
///
/// Dou and Chen, "Optimal features extraction of noisy sinusoidal signals", Eq. 2-5: for a fixed frequency
/// the problem is linear, what is left is a search over frequency. Two things differ from the paper (ERRATA):
/// an offset is fitted (IEEE Std 1057, four parameters), and the search starts from the highest peak of a
/// spectrum, because the cost has side lobes 1/(record length) wide and a golden-section search lands on
/// them. From there Gauss-Newton steps of the reduced problem reach the minimum.
///
/// A linear trend is fitted as well where it is there beyond doubt. Intervals are 95 %, from the noise that
/// is left: Student's t for white noise; where what is left is coloured, from its density about f (and about
/// zero for offset and trend); with an allowance for an encoder too coarse for the noise to smooth; and with
/// few periods in the record from the profile of the cost, which need not be symmetric.
///
/// Fails with a reason: too few rows, not a finite number, times that do not increase, no sine beyond the
/// noise, fewer than one period in the record.
Result<SineFit> sinefit(std::span<const double> t_s, std::span<const double> y,
                        const SineFitOptions& options = {});

}  // namespace cartwright
