#include "common/model/plant.hpp"

#include <cmath>

#include "common/model/hermite_root.hpp"
#include "common/model/plant_step.hpp"

namespace cartwright {

/// One mass through one inner step: Runge-Kutta between events. Friction is in one of three modes: sticking
/// (v = 0), sliding (level against the motion), or elastic (a bristle, before breakaway).
void Plant::hold_one_mass(double duration_s) noexcept {
  const PlantTerms& p = terms_;
  double left = duration_s;
  for (int event = 0; left > 0; ++event) {
    const double y = state_.position_m, v = state_.velocity_m_per_s, t = state_.time_s;
    const auto unresisted = [&](double y_now, double v_now, double t_now, double drive_now) {
      return p.driven(drive_now, v_now, 1.0) + p.pushes(y_now, t_now) + extra_push_;
    };
    double sign = sign_of(v);
    bool elastic = false;
    double bristle = state_.bristle_m;
    if (p.has_bristle) {
      const BristleMode mode = bristle_mode(bristle, v, p.level(y, v) / p.bristle_stiffness, [&] {
        return unresisted(y, v, t, drive(left).start) / p.bristle_stiffness;
      });
      bristle = mode.deflection_m;
      elastic = mode.elastic;
      sign = elastic ? 0 : sign_of(bristle);
    } else if (v == 0 && p.breaks_at_rest) {
      const double net = unresisted(y, 0, t, drive(left).start);
      const double held = p.level(y, 0);
      if (held > 0 && std::abs(net) <= held) {
        const double waits = release_s(left, [&](double time_s, double drive_now) {
          return std::abs(unresisted(y, 0, time_s, drive_now)) > held;
        });
        state_.time_s += waits;
        state_.armature_V = drive(waits).armature_V;
        left -= waits;
        continue;
      }
      sign = sign_of(net);
    }
    const auto rate = [&](double y_now, double v_now, double t_now, double drive_now) {
      const double friction = elastic ? p.bristle_stiffness * (bristle + (y_now - y))
                                      : (sign == 0 ? 0 : sign * p.level(y_now, v_now));
      return unresisted(y_now, v_now, t_now, drive_now) - friction;
    };
    double h = left;
    OneMass next = one_mass_after(h, rate);
    const bool may_stop = event < kEventsPerStep;
    if (p.has_current_limit && may_stop) {
      const double corner = sign_change(p.over_current(next.drive.start, v),
                                        p.over_current(next.drive.end, next.velocity_m_per_s));
      if (corner < 1) {
        h = std::max(corner * left, std::min(left, kLeastAdvance_s));
        next = one_mass_after(h, rate);
      }
    }
    bool stops = false;
    if (elastic) {
      // Breaks away where the bristle carries the level.
      const double pull = bristle + (next.position_m - y);
      const double side = sign_of(pull);
      const double over = side * pull - p.level(next.position_m, next.velocity_m_per_s) / p.bristle_stiffness;
      if (over > 0 && side * next.velocity_m_per_s > 0 && may_stop) {
        const double before = std::min(side * bristle - p.level(y, v) / p.bristle_stiffness, 0.0);
        h = std::max(h * hermite_root(before, side * v * h, over, side * next.velocity_m_per_s * h),
                     std::min(h, kLeastAdvance_s));
        next = one_mass_after(h, rate);
      }
    } else if (p.breaks_at_rest && next.velocity_m_per_s * sign < 0) {
      stops = true;
      if (may_stop) {
        const double end_rate = rate(next.position_m, next.velocity_m_per_s, t + h, next.drive.end);
        h *= hermite_root(v, next.start_rate * h, next.velocity_m_per_s, end_rate * h);
        next = one_mass_after(h, rate);
      }
    }
    state_.position_m = next.position_m;
    state_.velocity_m_per_s = stops ? 0 : next.velocity_m_per_s;
    if (p.has_bristle) {
      state_.bristle_m = elastic
                             ? bristle + (next.position_m - y)
                             : sign * p.level(next.position_m, state_.velocity_m_per_s) / p.bristle_stiffness;
    }
    state_.armature_V = next.drive.armature_V;
    state_.time_s += h;
    left -= h;
  }
  state_.motor_position_m = state_.position_m;
  state_.motor_velocity_m_per_s = state_.velocity_m_per_s;
}

}  // namespace cartwright
