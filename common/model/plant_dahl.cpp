#include <algorithm>
#include <cmath>

#include "common/model/hermite_root.hpp"
#include "common/model/plant.hpp"
#include "common/model/plant_step.hpp"

namespace cartwright {
namespace {

/// Less than this share of the level lacking, the bristle slides; before that a step takes no more than this
/// part of the way F/k over which it loads.
constexpr double kSliding = 1e-3, kWayPerStep = 0.5;

/// The share r of the friction level that a Dahl bristle carries after a way x one way, from a share r0:
///
///     dr/dx = (k / F) (1 - r)^n,   `way` = k x / F
///
/// k stiffness, F level. Exact for any way, so that sliding needs no small steps.
double carried(double r0, double way, double exponent) noexcept {
  const double left = std::max(1 - r0, 0.0);
  if (exponent == 1) return 1 - left * std::exp(-way);
  const double power = 1 - exponent;
  const double rest = std::pow(left, power) - power * way;
  return rest > 0 ? 1 - std::pow(rest, 1 / power) : 1.0;
}

/// How much of a way the bristle still takes, where it carries a share r of its level that way: (1 - r)^n.
double taken(double r, double exponent) noexcept {
  const double left = std::max(1 - r, 0.0);
  return exponent == 1 ? left : std::pow(left, exponent);
}

}  // namespace

/// One mass through one inner step where friction is a Dahl bristle: it neither sticks nor breaks away, it
/// carries a share r of its level F that grows the farther the cart moves one way, and damps what it takes of
/// that way:
///
///     friction = F r + d exp(-(v/w)^2) v (1 - r sgn v)^n
///
/// d damping, w the speed at which it fades; with n = 1 the LuGre model. Runge-Kutta between reversals.
void Plant::hold_dahl(double duration_s) noexcept {
  const PlantTerms& p = terms_;
  double left = duration_s;
  for (int event = 0; left > 0; ++event) {
    const double y = state_.position_m, v = state_.velocity_m_per_s, t = state_.time_s;
    const double level_before = p.level(y, v);
    const double share = level_before > 0 ? p.bristle_stiffness * state_.bristle_m / level_before : 0;
    const auto share_at = [&](double y_now, double level) {
      const double moved = y_now - y, side = moved != 0 ? sign_of(moved) : 1.0;
      const double way = std::abs(moved) * p.bristle_stiffness / level;
      return side * carried(std::clamp(side * share, -1.0, 1.0), way, p.dahl_exponent);
    };
    const auto friction = [&](double y_now, double v_now) {
      const double level = p.level(y_now, v_now);
      if (level <= 0) return 0.0;
      const double share_now = share_at(y_now, level);
      const double pull = level * share_now;
      if (p.bristle_damping == 0) return pull;
      const double x = v_now * p.bristle_inverse_speed;
      const double damping = p.bristle_damping * faded(x * x);
      return pull + damping * v_now * taken(sign_of(v_now) * share_now, p.dahl_exponent);
    };
    const auto rate = [&](double y_now, double v_now, double t_now, double drive_now) {
      return p.driven(drive_now, v_now, 1.0) + p.pushes(y_now, t_now) + extra_push_ - friction(y_now, v_now);
    };
    double h = left;
    if (v != 0 && 1 - sign_of(v) * share > kSliding) {
      const double way_m = level_before / p.bristle_stiffness;
      h = std::min(left, std::max(kWayPerStep * way_m / std::abs(v), duration_s / kEventsPerStep));
    }
    OneMass next = one_mass_after(h, rate);
    const bool reverses = v * next.velocity_m_per_s < 0 && event < kEventsPerStep;
    if (reverses) {
      const double end_rate = rate(next.position_m, next.velocity_m_per_s, t + h, next.drive.end);
      h = std::max(h * hermite_root(v, next.start_rate * h, next.velocity_m_per_s, end_rate * h),
                   std::min(h, kLeastAdvance_s));
      next = one_mass_after(h, rate);
    }
    state_.position_m = next.position_m;
    state_.velocity_m_per_s = reverses ? 0 : next.velocity_m_per_s;
    const double level_after = p.level(state_.position_m, state_.velocity_m_per_s);
    state_.bristle_m =
        level_after > 0 ? level_after * share_at(state_.position_m, level_after) / p.bristle_stiffness : 0;
    state_.armature_V = next.drive.armature_V;
    state_.time_s += h;
    left -= h;
  }
  state_.motor_position_m = state_.position_m;
  state_.motor_velocity_m_per_s = state_.velocity_m_per_s;
}

}  // namespace cartwright
