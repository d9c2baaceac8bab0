#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "common/result.hpp"
#include "host/relay/limit_cycle.hpp"

namespace cartwright {

/// The values a relay experiment is matched with, in the order of the vectors below.
enum class RelayValue { voltage_gain, viscous, coulomb, constant };
inline constexpr Eigen::Index kRelayValues = 4;

/// One relay recording and its cycles.
struct RelayRecording {
  const Recording* recording = nullptr;
  LimitCycle cycle;
};

struct RelayMatch {
  Eigen::Vector4d values;      ///< beta, c, F, g
  Eigen::Matrix4d covariance;  ///< rows of values held at a bound are zero
  double degrees = 1;          ///< of freedom behind the covariance
  bool coulomb_at_zero = false;
  std::vector<double> rms_m;  ///< what is left, per recording
  double mean_speed_m_per_s = 0;
  std::vector<std::vector<double>> predicted_m;  ///< per recording; NaN outside the cycles
};

/// Matches the measured limit cycles in the time domain.
///
///     d2y/dt2 = beta u - c v - F sgn(v) + g,   held still while |beta u + g| <= F                  [m/s^2]
///
/// Multiple shooting on the exact stick-slip solution (common/model/plant.hpp): over each cycle of each
/// recording the recorded voltage, held from tick to tick, drives the model from a start state (y0, v0) of
/// its own; beta, c, F and g are common to all. Gauss-Newton with a step guard, the start states eliminated.
/// No describing function, no derivative of the measurement, and the harmonics carry information instead of
/// bias. Starting afresh each cycle keeps small disturbances from adding up, and replaying the recorded
/// voltage keeps a slight difference of a switching time from growing.
///
/// Covariance: from the scatter of the cycles' scores about their sum, so that noise of any colour within a
/// cycle counts for what it is, plus what repeats itself from cycle to cycle (quantisation of a locked cycle,
/// physics the model lacks), which that scatter cannot show.
Result<RelayMatch> match_limit_cycles(const std::vector<RelayRecording>& recordings);

}  // namespace cartwright
