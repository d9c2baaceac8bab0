#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/control/feedforward.hpp"
#include "common/control/pd.hpp"

namespace cartwright {

/// What the adaptive law estimates, as in Eq. (10) of the relay paper, b x'' = a x' + u - F:
///
///     a   [V s/m]    less than zero: back-EMF and viscous friction
///     b   [V s^2/m]  inertia, 1/beta
///     f1  [V]        Coulomb friction
///     f2  [V s/m]    friction that grows with speed, beside a
///     f   [V]        bound on everything else
struct AdaptiveEstimates {
  enum Index : std::size_t { a, b, f1, f2, f };
  static constexpr std::size_t kCount = 5;
  std::array<double, kCount> value{};

  double& operator[](Index index) { return value[index]; }
  double operator[](Index index) const { return value[index]; }
};

struct AdaptiveSettings {
  double lambda1_per_s2 = 0;                   ///< of the sliding surface, Eq. (21)
  double lambda2_per_s = 0;                    ///< the same; 0: the model's damping rate c (`adaptive_about`)
  double kv_per_s = 0;                         ///< Kv of Eq. (25); acts with `own_feedback`
  double dead_zone_m_per_s = 0.005;            ///< delta of Eq. (22)
  double speed_filter_hz = 10;                 ///< first-order filter of the measured speeds
  double fastest_per_s = 1;                    ///< no estimate is to close in faster, whatever the reference
  double leakage_per_s = 0.1;                  ///< of f, which Eq. (31) only lets grow
  AdaptiveEstimates rate;                      ///< ka, kb, kf1, kf2, kf of Eq. (27)-(31)
  AdaptiveEstimates initial, least, greatest;  ///< start and projection of every estimate
  /// x' and sgn x' of Eq. (24)-(30) from the readings, as printed, instead of from the reference.
  bool measured_velocity = false;
  /// f2 sgn(x') x' = f2 |x'| of Eq. (24), (30) as printed. To show what it does.
  bool printed_f2 = false;
  /// The feedback terms of Eq. (25) as well. Not beside a PD law, which is that feedback (Remark 1).
  bool own_feedback = false;
};

/// The adaptive law of Tan, Lee and others ("Friction modeling and adaptive compensation using a relay
/// feedback approach", Eq. 21-31), as a voltage to be added to a feedback law:
///
///     s  = L1 int e + L2 e + e',   s_d = s - delta sat(s/delta)                            (21)-(23)
///     u  = -a x' - b u_c + f1 sgn x' + f2 x' + f sat(s_d/delta)                            (24)
///     u_c = -L1 e - L2 e' - x_r'' - Kv s_d                                                 (25)
///     a' = -ka x' s_d,  b' = -kb u_c s_d,  f1' = kf1 sgn x' s_d,  f2' = kf2 x' s_d,        (27)-(30)
///     f' = kf |s_d| - leakage f                                                            (31)
///
/// Where it departs from print, and why:
/// - Eq. (24), (26), (30) have sgn(x') x' for f2, which is |x'|: even in the direction, so no friction. Eq.
///   (13) asks for |x'| sgn x' = x'; f2 and -a are then one number, and only their sum means anything.
/// - f sgn(s_d) jumps by f at the edge of the dead zone, and chatters there; sat(s_d/delta) is continuous.
/// - f only grows in Eq. (31) (ERRATA): it leaks. Every estimate is held in [least, greatest] (projection).
/// - x' from a reading carries noise that s carries too, with the other sign: E[x' s] < 0 walks a away
///   although nothing is wrong. By default x' is the reference's, which no noise touches; the error system is
///   then that of Sadegh and Horowitz (1990).
/// - The rates of (27)-(30) are divided by 1 + sum k_i phi_i^2 / (fastest K), phi_i what stands beside k_i
/// and K
///   = Kd + Kp/L2 the feedback's gain on s (normalised gradient): a fast reference would else make the
///   adaptation faster than the loop it acts through, and unstable. Without a known feedback gain they are as
///   printed.
/// - s and, for (27)-(30), what stands beside the rates go through the same filter, so that it does not put
///   them out of step.
/// - Nothing adapts while the output is limited: the error then says nothing of friction.
///
/// Beside a PD law, s answers to what is wrong with the estimates through (p + L2)/(p^2 + (c + beta Kd) p +
/// beta Kp). That is positive real, which the proof needs, for L2 <= c + beta Kd: with more, references
/// faster than sqrt(beta Kp L2/(L2 - c - beta Kd)) drive the estimates to their limits.
///
/// No allocation, no exception.
class AdaptiveFriction {
 public:
  AdaptiveFriction() = default;
  AdaptiveFriction(const AdaptiveSettings& settings, double period_s);

  /// The feedback that the voltage is added to.
  void set_feedback(const PdGains& gains) noexcept;

  /// A new run: forgets errors and speeds, keeps the estimates.
  void restart() noexcept;

  /// The voltage of Eq. (24) for the hold that starts now, and one step of (27)-(31).
  double update(const ReferenceMotion& reference, double reference_m, double measured_m,
                bool limited) noexcept;

  /// What the initial estimates ask for along a reference.
  double initial_V(const ReferenceMotion& reference) const noexcept;

  const AdaptiveEstimates& estimates() const noexcept { return estimates_; }
  double sliding_m_per_s() const noexcept { return sliding_m_per_s_; }
  /// One bit per estimate that has stood at its least or greatest for half a second on end: it stays.
  std::uint16_t limits_met() const noexcept { return limits_met_; }

 private:
  struct Regressors {
    double velocity = 0, direction = 0, f2 = 0, u_c = 0;
  };
  void adapt(double outside) noexcept;

  AdaptiveSettings settings_;
  double period_s_ = 1e-3, smoothing_ = 0, feedback_V_s_per_m_ = 0;
  AdaptiveEstimates estimates_;
  Regressors filtered_;
  bool first_ = true;
  double error_m_ = 0, filtered_error_m_ = 0, measured_m_ = 0, integral_m_s_ = 0;
  double error_speed_m_per_s_ = 0, speed_m_per_s_ = 0, sliding_m_per_s_ = 0;
  std::array<double, AdaptiveEstimates::kCount> held_s_{};
  std::uint16_t limits_met_ = 0;
};

}  // namespace cartwright
