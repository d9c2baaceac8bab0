#pragma once

#include <cstdint>

#include "common/control/adaptive_friction.hpp"

namespace cartwright {

enum class CompensationMode : std::uint16_t { off, feed_forward, adaptive };

struct CompensationSettings {
  CompensationMode mode = CompensationMode::off;
  Model model{0};             ///< the identified model
  AdaptiveSettings adaptive;  ///< initial, least and greatest are set from the model: `adaptive_about`
  double limit_V = 6;         ///< the compensation never adds more than this, either sign
};

/// Start and projection of the estimates about a model: b = 1/beta, a = -c/beta, f1 = level/beta, f2 = f = 0.
/// With q = `range`, a and f1 may reach (1 + q) times their start and zero, b stays within a factor of 1 + q,
/// f2 within q |a|, f within q f1; where the model has no friction, 2 % of the voltage limit stands for it.
AdaptiveSettings adaptive_about(const Model& model, AdaptiveSettings settings, double range,
                                double voltage_limit_V);

/// A dead zone that rounding to this step does not leave by itself: half of what one count makes of the
/// sliding variable. More would be lost accuracy, as speeds taken from the reference know nothing of noise.
double quiet_dead_zone_m_per_s(const AdaptiveSettings& settings, double step_m, double period_s);

/// Friction compensation: a voltage to be added after the control law and before the limit, so that the law
/// stays what the contract says and a recording, which holds that voltage as `d_V`, replays exactly.
///
///     off            0
///     feed_forward   the model's inverse along the reference (feedforward.hpp)
///     adaptive       the same, with inertia, viscous and Coulomb friction taken from the adaptive law
///                    (adaptive_friction.hpp), which starts from the model
///
/// Settings change between two ticks without a bump: what the new ones would add to or take away from the
/// voltage is made up for and let go of with 0.2 s, and nothing adapts for a second: the error until then is
/// the old settings'. No allocation, no exception in `set` and `update`.
class Compensation {
 public:
  /// What is ready to run, made outside the loop.
  struct Prepared {
    CompensationMode mode = CompensationMode::off;
    FeedForward feed_forward;
    AdaptiveFriction adaptive;
    double limit_V = 6;
  };
  static Prepared prepare(const CompensationSettings& settings, double period_s);

  explicit Compensation(double period_s);

  void set(const Prepared& prepared) noexcept;
  /// A new run under these gains: the estimates stay.
  void restart(const PdGains& feedback = {}) noexcept;
  /// The gains change within a run.
  void set_feedback(const PdGains& feedback) noexcept;

  /// The voltage to add. `limited`: the last output was held back by the voltage or slew limit.
  double update(const ReferenceMotion& reference, double reference_m, double measured_m,
                bool limited) noexcept;

  /// What is in force, or about to be at the next update.
  CompensationMode mode() const noexcept { return pending_ ? next_.mode : active_.mode; }
  /// Whether the reference's movement matters to the next update.
  bool active() const noexcept {
    return active_.mode != CompensationMode::off || (pending_ && next_.mode != CompensationMode::off);
  }
  double voltage_V() const noexcept { return voltage_V_; }
  const AdaptiveFriction& adaptive() const noexcept { return active_.adaptive; }
  /// Bits of `AdaptiveFriction::limits_met`, and the next one where the whole was held at `limit_V`. Sticky
  /// until the next `set`.
  std::uint16_t limits_met() const noexcept;

 private:
  static double wanted_V(Prepared& law, const ReferenceMotion& reference, double reference_m,
                         double measured_m, bool limited) noexcept;

  Prepared active_, next_;
  PdGains feedback_;
  bool pending_ = false, whole_limited_ = false;
  int settle_ticks_, settling_ = 0;  ///< ticks without adaptation after a change
  double bump_decay_, bump_V_ = 0, voltage_V_ = 0;
};

}  // namespace cartwright
