#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/diagnose/locate/profile.hpp"

namespace cartwright {

/// Missing acceleration as a function of one axis, estimated without naming any physics: one push per bin,
/// all bins of the axis and the model's own numbers fitted jointly to the one-step errors through what the
/// observer would show (influence.hpp). `band` holds for all bins of all axes at once (Bonferroni, 95 %).
struct AxisMap {
  std::string axis;    ///< `position_m`, `velocity_m_per_s`, ... as in diagnosis.json
  std::string parity;  ///< "even": the same push both ways; "odd": a push against the motion; "" elsewhere
  std::vector<double> low, high;      ///< bin edges
  std::vector<std::string> names;     ///< of the bins, where they are no numbers: the recordings
  std::vector<double> push_m_per_s2;  ///< estimate; for odd maps positive is extra friction
  std::vector<double> band_m_per_s2;  ///< half width of the simultaneous band
  double gain = 0;                    ///< log-likelihood gained by the whole axis [nats]
  double bar = 0;         ///< what chance alone reaches on one of the axes in 1 of 2000 sessions; more where
                          ///< a cart that is exactly the model comes near that
  double alike_gain = 0;  ///< what such a cart gains on an axis of its own [nats]
  double share = 0;       ///< of the disturbance power that the observer had to add
  bool flat() const { return gain <= bar; }
  /// What white errors gain on average.
  double mean() const { return 0.5 * static_cast<double>(low.size()); }
  /// The widest stretch of neighbouring bins outside the band; empty where there is none.
  std::vector<double> stretch() const;
};

struct Location {
  std::vector<AxisMap> axes;
  double beyond_chance = 1;  ///< by which a bar is lifted, most of all axes
  Profile over_way, over_frequency, over_lag;
  double repeat_correlation = 0;  ///< of smoothed errors between repeats; 0 without repeats
  double repeat_z = 0;            ///< that, in standard errors

  std::array<const Profile*, 3> profiles() const { return {&over_way, &over_frequency, &over_lag}; }
};

/// The recordings of a session by a cart that is exactly a fit's model, and what the fit's errors are there.
struct Alike {
  Session session;
  std::vector<double> error_m;
};

/// What the errors of `alike` gain beyond chance along any axis of the session, or along the middle one of
/// its own, lifts all bars; what they gain along an axis of its own, that axis's.
Location locate(const Session& session, const Fit& fit, const Alike& alike, const FitOptions& options);

}  // namespace cartwright
