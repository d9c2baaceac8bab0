#pragma once

#include <vector>

#include "common/config/rig.hpp"

namespace cartwright {

/// What the model does not determine: a disturbance acceleration d that wanders with a correlation time, and
/// a reading error. Only their ratio shapes the observer; the size of both is concentrated out of the
/// likelihood.
struct NoiseModel {
  double disturbance_per_reading_per_s2 = 1e4;  ///< std(d) / std(reading error) [1/s^2]
  double correlation_time_s = 0.02;             ///< of d; bounded above, or the noise swallows the plant

  static constexpr double kLongestCorrelation_s = 0.03;
  static constexpr double kShortestCorrelation_s = 0.0002;
};

/// The nearest noise that an observer may be made for. Where readings are rounded the disturbance is at least
/// so large that the observer averages over no more than about ten of them: a cart that stands or creeps is
/// read with the same rounding error again and again, which is no white noise, and what a longer memory makes
/// of it looks like physics. From the gain of a cart that white noise pushes, K^4 = 8 r^2 tau T^3.
NoiseModel bounded(NoiseModel noise, const Rig& rig);

/// Kalman gains of the linear cart  y' = v, v' = -c v + d, d' = -d/tau + white  read at a fixed period.
struct ObserverGain {
  double position = 0;              ///< [-]
  double velocity_per_s = 0;        ///< [1/s]
  double disturbance_per_s2 = 0;    ///< [1/s^2]
  double disturbance_decay = 0;     ///< d(k+1)/d(k), exp(-T/tau)
  double error_variance_ratio = 1;  ///< variance of the one-step error over that of the reading error
};

/// The gains from a start whose position is as sure as a reading and whose speed is hardly known, reading by
/// reading, to where they rest.
struct ObserverGains {
  std::vector<ObserverGain> starting;  ///< of rows 1, 2, ... after the start
  ObserverGain settled;
  NoiseModel noise;  ///< what they come from
  double damping_per_s = 0;

  static constexpr std::size_t kSettledRow = static_cast<std::size_t>(-1);
  /// The gain of a row, counted from the start, which is row 0.
  const ObserverGain& at(std::size_t row) const {
    return row - 1 < starting.size() ? starting[row - 1] : settled;
  }
};

/// Iterates the Riccati equation of the three-state model to rest.
ObserverGains observer_gains(const NoiseModel& noise, double period_s, double damping_per_s);

}  // namespace cartwright
