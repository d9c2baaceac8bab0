#include "common/model/plant.hpp"

#include <cmath>

#include "common/model/plant_step.hpp"

namespace cartwright {
namespace {

/// (e^z - 1)/z and (e^z - 1 - z)/z^2, as series where the closed forms would cancel.
struct Growth {
  double first, second;
};

Growth growth(double z) noexcept {
  if (std::abs(z) > 0.03) {
    const double first = std::expm1(z) / z;
    return {first, (first - 1) / z};
  }
  const double second = 0.5 + z * (1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120 + z * (1.0 / 720 + z / 5040))));
  return {1 + z * second, second};
}

}  // namespace

Plant::Plant(const Model& model, const PlantOptions& options)
    : terms_(model, options.disturbance_active),
      series_(terms_.linear_two_masses || (options.linear_by_steps && terms_.linear_two_masses_by_steps)),
      step_s_(std::min(options.step_s, options.stiff_step_factor *
                                           (series_ ? terms_.longest_series_step_s : terms_.longest_step_s))),
      apart_step_s_(std::min(options.step_s, options.stiff_step_factor * terms_.longest_apart_step_s)),
      heating_start_s_(options.heating_start_s) {}

void Plant::reset(const PlantState& state) {
  state_ = state;
  delay_line_.clear();
  target_V_ = delayed_V_ = state.armature_V;
  if (!terms_.two_masses) {
    state_.motor_position_m = state.position_m;
    state_.motor_velocity_m_per_s = state.velocity_m_per_s;
    return;
  }
  find_contact();
}

/// Teeth that give are in contact where they overlap; rigid ones are held together once they are.
void Plant::find_contact() noexcept {
  if (terms_.gap == 0) return;
  const double half = 0.5 * terms_.gap;
  const double stretch = state_.motor_position_m - state_.position_m;
  if (!terms_.rigid_backlash) {
    state_.contact = stretch > half ? 1 : (stretch < -half ? -1 : 0);
  } else if (state_.contact != 0) {
    state_.motor_position_m = state_.position_m + half * state_.contact;
    state_.motor_velocity_m_per_s = state_.velocity_m_per_s;
  } else {
    state_.motor_position_m = state_.position_m + std::clamp(stretch, -half, half);
  }
}

void Plant::reset(double position_m, double velocity_m_per_s, double time_s) {
  PlantState s;
  s.position_m = s.motor_position_m = position_m;
  s.velocity_m_per_s = s.motor_velocity_m_per_s = velocity_m_per_s;
  s.time_s = time_s;
  reset(s);
}

void Plant::correct(double position_m, double velocity_m_per_s) {
  state_.motor_position_m += position_m - state_.position_m;
  state_.motor_velocity_m_per_s += velocity_m_per_s - state_.velocity_m_per_s;
  state_.position_m = position_m;
  state_.velocity_m_per_s = velocity_m_per_s;
}

void Plant::correct(double position_m, double velocity_m_per_s, double motor_position_m,
                    double motor_velocity_m_per_s) {
  state_.position_m = position_m;
  state_.velocity_m_per_s = velocity_m_per_s;
  state_.motor_position_m = motor_position_m;
  state_.motor_velocity_m_per_s = motor_velocity_m_per_s;
  find_contact();
}

void Plant::advance(double command_V, double duration_s, double push_m_per_s2) noexcept {
  extra_push_ = push_m_per_s2;
  const double shaped = terms_.amplifier(command_V);
  if (!terms_.has_delay) {
    hold(shaped, duration_s);
    return;
  }
  const double end = state_.time_s + duration_s;
  delay_line_.push(state_.time_s + terms_.delay, shaped);
  while (delay_line_.arrives_before(end)) {
    hold(delayed_V_, delay_line_.next_arrival_s() - state_.time_s);
    delayed_V_ = delay_line_.pop();
  }
  hold(delayed_V_, end - state_.time_s);
  state_.time_s = end;
}

void Plant::hold(double shaped_V, double duration_s) noexcept {
  if (!(duration_s > 0)) return;
  target_V_ = shaped_V;
  const double end = state_.time_s + duration_s;
  if (terms_.linear || series_) {
    terms_.linear ? hold_linear(duration_s) : hold_two_masses_linear(duration_s);
    state_.time_s = end;
    return;
  }
  const auto run = [&](double span_s) {
    const int steps = steps_over(span_s, step_s_);
    for (int i = 0; i < steps; ++i) {
      if (terms_.two_masses) {
        hold_two_masses(span_s / steps);
      } else if (terms_.has_dahl_bristle) {
        hold_dahl(span_s / steps);
      } else {
        hold_one_mass(span_s / steps);
      }
    }
  };
  if (terms_.has_disturbance) {
    // The push begins and ends with a corner: steps end there.
    const double first = terms_.disturbance_start, last = first + terms_.disturbance_duration;
    for (const double corner : {first, last}) {
      if (corner > state_.time_s && corner < end) {
        run(corner - state_.time_s);
        state_.time_s = corner;
      }
    }
  }
  if (end > state_.time_s) run(end - state_.time_s);
  state_.time_s = end;
}

Plant::Drive Plant::drive(double duration_s) const noexcept {
  const double settled = terms_.beta * target_V_;
  Drive d{settled, settled, settled, target_V_};
  if (!terms_.varies_in_time) return d;
  if (terms_.has_lag) {
    const double off_V = state_.armature_V - target_V_;
    const double half = std::exp(-0.5 * duration_s * terms_.lag_rate);
    d.start += terms_.beta * off_V;
    d.middle += terms_.beta * off_V * half;
    d.armature_V += off_V * half * half;
    d.end = terms_.beta * d.armature_V;
  }
  if (terms_.has_heating) {
    const double cold = std::exp(-(state_.time_s - heating_start_s_) * terms_.heating_rate);
    const double half = std::exp(-0.5 * duration_s * terms_.heating_rate);
    d.start *= 1 - terms_.heating_loss * (1 - cold);
    d.middle *= 1 - terms_.heating_loss * (1 - cold * half);
    d.end *= 1 - terms_.heating_loss * (1 - cold * half * half);
  }
  return d;
}

/// v' = net - c v with constant net: v(t) = v + a t (e^z - 1)/z, y(t) = y + v t + a t^2 (e^z - 1 - z)/z^2, z
/// = -c t. Exact for any duration. The velocity crosses zero at most once: there the cart sticks, or goes on
/// the other way.
void Plant::hold_linear(double duration_s) noexcept {
  const double push = terms_.beta * target_V_ + extra_push_ + terms_.constant;
  double y = state_.position_m, v = state_.velocity_m_per_s, left = duration_s;
  while (left > 0) {
    double sign = sign_of(v);
    if (sign == 0) {
      if (std::abs(push) <= terms_.coulomb) break;
      sign = sign_of(push);
    }
    const double c = terms_.viscous * (1 + 0.5 * terms_.viscous_difference * sign);
    const double net = push - terms_.coulomb * sign;
    const double a = net - c * v;
    Growth g = growth(-c * left);
    const double end = v + a * left * g.first;
    if (end * sign >= 0 || !terms_.breaks_at_rest) {
      y += left * (v + a * left * g.second);
      v = end;
      break;
    }
    // Zero at t = ln(1 - c v/net)/c; net opposes v, so the argument exceeds one.
    const double h = std::min(left, c > 0 ? std::log1p(-c * v / net) / c : -v / net);
    g = growth(-c * h);
    y += h * (v + a * h * g.second);
    v = 0;
    left -= h;
  }
  state_.position_m = state_.motor_position_m = y;
  state_.velocity_m_per_s = state_.motor_velocity_m_per_s = v;
  state_.armature_V = target_V_;
}

}  // namespace cartwright
