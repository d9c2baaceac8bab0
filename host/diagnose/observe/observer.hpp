#pragma once

#include <vector>

#include "common/model/model.hpp"
#include "host/diagnose/observe/noise.hpp"
#include "host/session/session.hpp"

namespace cartwright {

/// The one-step prediction errors of one recording and the states they were made from.
struct Observation {
  std::vector<double> error_m;           ///< y(k) - predicted y(k) from rows before k; row 0 is 0
  std::vector<double> spread;            ///< std of an error over that of the reading; empty: all the same
  std::vector<double> velocity_m_per_s;  ///< predicted, before the correction (only if asked for)
  /// From row k - 1 to k, predicted like the velocity: what readings from k on say of it holds the very
  /// disturbance that is to be explained.
  std::vector<double> acceleration_m_per_s2;
  std::vector<double> disturbance_m_per_s2;  ///< acceleration the observer had to add (only if asked for)
};

/// Damping of a model for the gain's linear cart: what it says at moderate speed.
double linear_damping(const Model& model);

struct ObserverOptions {
  bool keep_states = false;
  double step_s = 1e-3;   ///< greatest inner step of the plant
  bool coarsely = false;  ///< stiff friction only as well as tells whether it is worth looking at
};

/// Runs the physical model beside a recording: the recorded voltage held over each tick, friction sticking
/// exactly, and after each reading a correction of position, velocity and the disturbance
/// acceleration:
///
///     e(k) = y(k) - h(x(k)),   x(k) += K e(k),   v(k) += Kv e(k),   d(k) = phi d(k) + Kd e(k)
///
/// With a gap between motor and cart the gain depends on whether they touch (`TwoMassGain`) and the motor is
/// corrected apart. Were model and noise right, e would be white; its mean square is then the likelihood of
/// the recording.
Observation observe(const Model& model, const ObserverGains& gains, const Rig& rig,
                    const Recording& recording, const ObserverOptions& options = {});

/// The same of every recording of a session, so many at a time.
std::vector<Observation> observe(const Model& model, const ObserverGains& gains, const Session& session,
                                 const ObserverOptions& options, unsigned threads);

/// Rows at the beginning of a recording while the observer settles; they do not count.
std::size_t settling_rows(const Rig& rig);

}  // namespace cartwright
