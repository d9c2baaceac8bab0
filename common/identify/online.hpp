#pragma once

#include "common/identify/model_monitor.hpp"
#include "common/identify/online_identifier.hpp"
#include "common/identify/twin.hpp"

namespace cartwright {

struct OnlineSetup {
  MovingRowsSetup rows;
  double window_s = 0.1;
  double voltage_limit_V = 12;
};

/// Identification while the rig runs: rows in, estimates and the monitor's judgement out. The model that the
/// monitor holds recordings against is the one it was given; without one, the rig's own, once a dozen blocks
/// (some twelve seconds of movement) are behind it. The first six blocks, from before there was a model
/// to run a twin of, only start it: what feedback does to them is not carried along. No allocation, no
/// exception in what runs inside a tick.
class OnlineIdentification {
 public:
  explicit OnlineIdentification(const OnlineSetup& setup);

  /// Forgets everything but the model.
  void restart() noexcept;
  /// The model to hold recordings against; a voltage gain of zero: none.
  void set_model(const PlantTerms& terms) noexcept;

  /// A recording under a PD or PID law starts. `end`: the rows to come belong to no known law.
  void begin(const PidGains& gains) noexcept;
  void end() noexcept;

  /// A tick: its reading, the voltage put out from then on, reference and added voltage.
  void tick(double t_s, double y_m, double u_V, double reference_m, double added_V) noexcept;

  const OnlineEstimates& estimates() const noexcept { return identifier_.estimates(); }
  const ModelMonitor& monitor() const noexcept { return monitor_; }

 private:
  static constexpr std::size_t kOwnModelBlocks = 12;
  void take_new_estimates() noexcept;

  MovingRows rows_;
  WeakWindows windows_;
  OnlineIdentifier identifier_;
  ModelMonitor monitor_;
  Twin twin_;
  PlantTerms terms_;
  bool given_ = false, own_ = false, twinned_ = false;
};

}  // namespace cartwright
