#include "common/model/plant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cartwright {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
/// Inner steps resolve the fastest natural frequency w of a model to w h = 0.15: the method's local error is then
/// (w h)^5/120 < 1e-6 of the amplitude.
constexpr double kStepTimesFrequency = 0.15;
constexpr double kLeastStep_s = 2e-5;
/// Events (stick, slip, contact) handled inside one inner step before the rest of it is taken as it comes.
constexpr int kEventsPerStep = 8;

double sign_of(double value) { return value > 0 ? 1.0 : (value < 0 ? -1.0 : 0.0); }

/// First root in (0, 1] of the cubic Hermite through (0, p0) with slope d0 and (1, p1) with slope d1, p0 and p1 of
/// opposite signs or p0 = 0. Newton steps kept inside a shrinking bracket.
double hermite_root(double p0, double d0, double p1, double d1) {
  double low = 0, high = 1;
  double x = p0 == p1 ? 1.0 : std::clamp(p0 / (p0 - p1), 0.0, 1.0);
  const double c2 = 3 * (p1 - p0) - 2 * d0 - d1;
  const double c3 = 2 * (p0 - p1) + d0 + d1;
  for (int i = 0; i < 30; ++i) {
    const double value = p0 + x * (d0 + x * (c2 + x * c3));
    if ((value > 0) == (p1 > 0)) {
      high = x;
    } else {
      low = x;
    }
    const double slope = d0 + x * (2 * c2 + 3 * c3 * x);
    double next = slope != 0 ? x - value / slope : 0.5 * (low + high);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < 1e-13) break;
    x = next;
  }
  return x;
}

}  // namespace

Plant::Plant(const Model& m, const PlantOptions& options) {
  const auto value = [&m](Term term, Parameter parameter, double absent) {
    return m.has(term) ? m[parameter] : absent;
  };
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  beta_ = m[Parameter::voltage_gain];
  viscous_ = value(Term::viscous_friction, Parameter::viscous_coefficient, 0);
  viscous_difference_ = value(Term::asymmetric_viscous_friction, Parameter::asymmetric_viscous_difference, 0);
  coulomb_ = value(Term::coulomb_friction, Parameter::coulomb_level, 0);
  alpha1_ = value(Term::exponential_damping, Parameter::exponential_alpha1, 0);
  alpha2_ = value(Term::exponential_damping, Parameter::exponential_alpha2, 0);
  gamma_ = value(Term::exponential_damping, Parameter::exponential_gamma, 0);
  stribeck_excess_ = value(Term::stribeck_friction, Parameter::stribeck_excess, 0);
  stribeck_inverse_speed_ = 1 / value(Term::stribeck_friction, Parameter::stribeck_speed, 1);
  spot_peak_ = value(Term::position_dependent_friction, Parameter::spot_peak, 0);
  spot_centre_ = value(Term::position_dependent_friction, Parameter::spot_centre, 0);
  spot_inverse_width_ = 1 / value(Term::position_dependent_friction, Parameter::spot_width, 1);
  constant_ = value(Term::constant_force, Parameter::constant_acceleration, 0);
  cogging_amplitude_ = value(Term::cogging, Parameter::cogging_amplitude, 0);
  cogging_wavenumber_ = kTwoPi / value(Term::cogging, Parameter::cogging_period, 1);
  cogging_phase_ = value(Term::cogging, Parameter::cogging_phase, 0);
  spring_ = value(Term::cable_spring, Parameter::spring_stiffness, 0);
  spring_neutral_ = value(Term::cable_spring, Parameter::spring_neutral, 0);
  drag_ = value(Term::quadratic_drag, Parameter::drag_coefficient, 0);
  dead_zone_ = value(Term::input_dead_zone, Parameter::dead_zone_half_width, 0);
  saturation_ = value(Term::voltage_saturation, Parameter::saturation_limit, kNoLimit);
  gain_difference_ = value(Term::amplifier_gain_asymmetry, Parameter::amplifier_gain_difference, 0);
  current_limit_ = value(Term::current_limit, Parameter::current_limit, kNoLimit);
  const double lag = value(Term::armature_lag, Parameter::armature_time_constant, 0);
  delay_ = value(Term::transport_delay, Parameter::transport_delay, 0);
  heating_loss_ = value(Term::motor_heating, Parameter::heating_gain_loss, 0);
  heating_rate_ = 1 / value(Term::motor_heating, Parameter::heating_time_constant, 1);
  heating_start_ = options.heating_start_s;
  disturbance_start_ = m[Parameter::disturbance_start];
  disturbance_duration_ = m[Parameter::disturbance_duration];
  disturbance_peak_ = m[Parameter::disturbance_peak];
  bristle_stiffness_ = value(Term::presliding_friction, Parameter::presliding_stiffness, 0);
  gap_ = value(Term::backlash, Parameter::backlash_gap, 0);

  has_level_shape_ = stribeck_excess_ != 0 || spot_peak_ != 0;
  has_exponential_ = m.has(Term::exponential_damping);
  has_cogging_ = cogging_amplitude_ != 0;
  has_current_limit_ = m.has(Term::current_limit);
  has_lag_ = lag > 0;
  lag_rate_ = has_lag_ ? 1 / lag : 0;
  has_delay_ = delay_ > 0;
  has_heating_ = heating_loss_ != 0;
  has_disturbance_ = m.has(Term::external_disturbance) && options.disturbance_active;
  has_bristle_ = bristle_stiffness_ > 0;
  const bool flexible = m.has(Term::flexible_coupling);
  two_masses_ = flexible || gap_ > 0;
  rigid_backlash_ = !flexible && gap_ > 0;
  step_s_ = options.step_s;

  const bool shares_of_coupling = flexible;
  load_share_ =
      m[shares_of_coupling ? Parameter::coupling_load_share : Parameter::backlash_load_share];
  load_friction_share_ = m[shares_of_coupling ? Parameter::coupling_load_friction_share
                                              : Parameter::backlash_load_friction_share];
  load_damping_share_ = m[shares_of_coupling ? Parameter::coupling_load_damping_share
                                             : Parameter::backlash_load_damping_share];
  coupling_stiffness_ = coupling_damping_ = 0;
  const auto resolve = [this](double rad_per_s) {
    step_s_ = std::min(step_s_, std::max(kStepTimesFrequency / rad_per_s, kLeastStep_s));
  };
  if (flexible) {
    // Relative motion x = x_motor - x_load of two free masses: x'' = -k x (1/s + 1/(1 - s)) = -w^2 x.
    const double w = kTwoPi * m[Parameter::coupling_resonance];
    const double reduced = load_share_ * (1 - load_share_);
    coupling_stiffness_ = w * w * reduced;
    coupling_damping_ = 2 * m[Parameter::coupling_damping_ratio] * w * reduced;
    resolve(w * std::max(1.0, 2 * m[Parameter::coupling_damping_ratio]));
  }
  if (has_bristle_) resolve(std::sqrt(bristle_stiffness_));
  if (has_lag_) step_s_ = std::min(step_s_, std::max(lag, kLeastStep_s));
}

void Plant::reset(const PlantState& state) {
  state_ = state;
  if (!two_masses_) {
    state_.motor_position_m = state.position_m;
    state_.motor_velocity_m_per_s = state.velocity_m_per_s;
  }
  target_V_ = lag_start_V_ = state.armature_V;
  lag_start_s_ = state.time_s;
  delay_head_ = delay_count_ = 0;
  delayed_V_ = 0;
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

void Plant::advance(double command_V, double duration_s, double push_m_per_s2) noexcept {
  extra_push_ = push_m_per_s2;
  const double shaped = static_map(command_V);
  if (!has_delay_) {
    hold(shaped, duration_s);
    return;
  }
  const double end = state_.time_s + duration_s;
  if (delay_count_ < kDelayCapacity) {
    delay_line_[(delay_head_ + delay_count_) % kDelayCapacity] = {state_.time_s + delay_, shaped};
    ++delay_count_;
  }
  while (delay_count_ > 0 && delay_line_[delay_head_].time_s < end) {
    const Switch next = delay_line_[delay_head_];
    if (next.time_s > state_.time_s) hold(delayed_V_, next.time_s - state_.time_s);
    delayed_V_ = next.voltage_V;
    delay_head_ = (delay_head_ + 1) % kDelayCapacity;
    --delay_count_;
  }
  if (end > state_.time_s) hold(delayed_V_, end - state_.time_s);
  state_.time_s = end;
}

double Plant::static_map(double command_V) const noexcept {
  double u = command_V;
  if (dead_zone_ > 0) u = std::abs(u) <= dead_zone_ ? 0.0 : u - std::copysign(dead_zone_, u);
  u = std::clamp(u, -saturation_, saturation_);
  return u * (1 + 0.5 * gain_difference_ * sign_of(u));
}

void Plant::hold(double shaped_V, double duration_s) noexcept {
  target_V_ = shaped_V;
  lag_start_V_ = state_.armature_V;
  lag_start_s_ = state_.time_s;
  const double end = state_.time_s + duration_s;
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / step_s_ - 1e-6)));
  const double h = duration_s / steps;
  for (int i = 0; i < steps; ++i) {
    if (two_masses_) {
      hold_two_masses(h);
    } else {
      hold_one_mass(h);
    }
  }
  state_.armature_V = has_lag_ ? target_V_ + (lag_start_V_ - target_V_) * std::exp(-duration_s * lag_rate_)
                               : shaped_V;
  state_.time_s = end;
}

double Plant::drive(double time_s) const noexcept {
  double u = target_V_;
  if (has_lag_) u += (lag_start_V_ - target_V_) * std::exp(-(time_s - lag_start_s_) * lag_rate_);
  double a = beta_ * u;
  if (has_heating_) a *= 1 - heating_loss_ * (1 - std::exp(-(time_s - heating_start_) * heating_rate_));
  return a;
}

double Plant::damping(double v) const noexcept {
  const double speed = std::abs(v);
  double a = drag_ * speed * v + viscous_ * (1 + 0.5 * viscous_difference_ * sign_of(v)) * v;
  if (has_exponential_) a += (alpha1_ * std::exp(-alpha2_ * speed) + gamma_) * v;
  return a;
}

/// Drive less the damping on the side that carries `damping_share` of it. The current limit acts on drive less
/// back-EMF, beta u - c v.
double Plant::driven(double drive_m_per_s2, double v, double damping_share) const noexcept {
  if (!has_current_limit_) return drive_m_per_s2 - damping_share * damping(v);
  const double back_emf = viscous_ * v;
  return std::clamp(drive_m_per_s2 - back_emf, -current_limit_, current_limit_) -
         damping_share * (damping(v) - back_emf);
}

double Plant::level(double y, double v) const noexcept {
  double a = coulomb_;
  if (!has_level_shape_) return a;
  if (stribeck_excess_ != 0) {
    const double x = v * stribeck_inverse_speed_;
    a += stribeck_excess_ * std::exp(-x * x);
  }
  if (spot_peak_ != 0) {
    const double x = (y - spot_centre_) * spot_inverse_width_;
    a += spot_peak_ * std::exp(-0.5 * x * x);
  }
  return a;
}

double Plant::pushes(double y, double time_s) const noexcept {
  double a = constant_ + extra_push_ - spring_ * (y - spring_neutral_);
  if (has_cogging_) a += cogging_amplitude_ * std::sin(cogging_wavenumber_ * y + cogging_phase_);
  if (has_disturbance_) {
    const double x = (time_s - disturbance_start_) / disturbance_duration_;
    if (x > 0 && x < 1) a += disturbance_peak_ * std::sin(std::numbers::pi * x);
  }
  return a;
}

double Plant::one_mass_rate(double y, double v, double t, double sign) const noexcept {
  double a = driven(drive(t), v, 1.0) + pushes(y, t);
  if (has_bristle_) {
    const double most = level(y, v) / bristle_stiffness_;
    a -= bristle_stiffness_ * std::clamp(state_.bristle_m + (y - state_.position_m), -most, most);
  } else {
    a -= level(y, v) * sign;
  }
  return a;
}

void Plant::hold_one_mass(double duration) noexcept {
  const double y_begin_of_hold = state_.position_m;
  double left = duration;
  for (int event = 0; left > 0; ++event) {
    const double y = state_.position_m, v = state_.velocity_m_per_s, t = state_.time_s;
    double sign = sign_of(v);
    if (v == 0 && !has_bristle_) {
      const double net = one_mass_rate(y, 0, t, 0);
      if (std::abs(net) <= level(y, 0)) {
        state_.time_s += left;
        break;
      }
      sign = sign_of(net);
    }
    const auto step = [&](double h, double& y1, double& v1) {
      const double k1 = one_mass_rate(y, v, t, sign);
      const double v2 = v + 0.5 * h * k1;
      const double k2 = one_mass_rate(y + 0.5 * h * v, v2, t + 0.5 * h, sign);
      const double v3 = v + 0.5 * h * k2;
      const double k3 = one_mass_rate(y + 0.5 * h * v2, v3, t + 0.5 * h, sign);
      const double v4 = v + h * k3;
      const double k4 = one_mass_rate(y + h * v3, v4, t + h, sign);
      y1 = y + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v1 = v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      return k1;
    };
    double y1, v1;
    const double k1 = step(left, y1, v1);
    if (has_bristle_ || v1 * sign >= 0 || event >= kEventsPerStep) {
      if (has_bristle_) {
        const double most = level(y1, v1) / bristle_stiffness_;
        state_.bristle_m = std::clamp(state_.bristle_m + (y1 - y_begin_of_hold), -most, most);
      } else if (v1 * sign < 0) {
        v1 = 0;
      }
      state_.position_m = y1;
      state_.velocity_m_per_s = v1;
      state_.time_s += left;
      break;
    }
    // The velocity crosses zero: stop exactly there, then see whether friction holds.
    const double end_rate = one_mass_rate(y1, v1, t + left, sign);
    const double theta = v == 0 ? 1.0 : hermite_root(v, k1 * left, v1, end_rate * left);
    const double h = theta * left;
    step(h, y1, v1);
    state_.position_m = y1;
    state_.velocity_m_per_s = 0;
    state_.time_s += h;
    left -= h;
  }
  state_.motor_position_m = state_.position_m;
  state_.motor_velocity_m_per_s = state_.velocity_m_per_s;
}

/// Force of the coupling on the load, per unit of the whole mass.
double Plant::coupling_force(const PlantState& s) const noexcept {
  const double stretch = s.motor_position_m - s.position_m;
  const double half = 0.5 * gap_;
  double x = 0;
  if (stretch > half) x = stretch - half;
  if (stretch < -half) x = stretch + half;
  if (gap_ > 0 && x == 0) return 0;
  return coupling_stiffness_ * x + coupling_damping_ * (s.motor_velocity_m_per_s - s.velocity_m_per_s);
}

/// Accelerations of cart and motor for fixed friction directions; a sign of zero leaves friction out.
Plant::Rates Plant::two_mass_rates(const PlantState& s, double cart_sign, double motor_sign) const noexcept {
  const double motor_share = 1 - load_share_;
  const double v = s.velocity_m_per_s;
  double friction;
  const double whole_level = level(s.position_m, v);
  if (has_bristle_) {
    const double most = load_friction_share_ * whole_level / bristle_stiffness_;
    friction = bristle_stiffness_ *
               std::clamp(state_.bristle_m + (s.position_m - state_.position_m), -most, most);
  } else {
    friction = load_friction_share_ * whole_level * cart_sign;
  }
  const double cart = pushes(s.position_m, s.time_s) - load_damping_share_ * damping(v) - friction;
  const double motor =
      driven(drive(s.time_s), s.motor_velocity_m_per_s, 1 - load_damping_share_) -
      (1 - load_friction_share_) * level(s.motor_position_m, s.motor_velocity_m_per_s) * motor_sign;
  if (rigid_backlash_) {
    if (s.contact != 0) return {cart + motor, cart + motor};
    return {cart / load_share_, motor / motor_share};
  }
  const double force = coupling_force(s);
  return {(cart + force) / load_share_, (motor - force) / motor_share};
}

/// In contact the motor pushes the cart: lets go when it would have to pull.
void Plant::settle_contact() noexcept {
  if (!rigid_backlash_ || state_.contact == 0) return;
  PlantState apart = state_;
  apart.contact = 0;
  const double side = state_.contact;
  double cart_sign = sign_of(state_.velocity_m_per_s), motor_sign = cart_sign;
  if (cart_sign == 0) {
    // At rest each mass would start, if at all, the way its own net force points.
    const Rates net = two_mass_rates(apart, 0, 0);
    const double cart_level = load_friction_share_ * level(state_.position_m, 0) / load_share_;
    const double motor_level =
        (1 - load_friction_share_) * level(state_.motor_position_m, 0) / (1 - load_share_);
    const double cart = has_bristle_ || std::abs(net.cart) > cart_level
                            ? net.cart - (has_bristle_ ? 0.0 : sign_of(net.cart) * cart_level)
                            : 0.0;
    const double motor =
        std::abs(net.motor) > motor_level ? net.motor - sign_of(net.motor) * motor_level : 0.0;
    if ((motor - cart) * side < 0) state_.contact = 0;
    return;
  }
  const Rates alone = two_mass_rates(apart, cart_sign, motor_sign);
  if ((alone.motor - alone.cart) * side < 0) state_.contact = 0;
}

void Plant::hold_two_masses(double duration) noexcept {
  double left = duration;
  for (int event = 0; left > 1e-12; ++event) {
    settle_contact();
    const bool joined = rigid_backlash_ && state_.contact != 0;
    const PlantState s0 = state_;
    double cart_sign = sign_of(s0.velocity_m_per_s);
    double motor_sign = joined ? cart_sign : sign_of(s0.motor_velocity_m_per_s);
    const Rates net = two_mass_rates(s0, 0, 0);
    bool cart_stuck = false, motor_stuck = false;
    const double cart_level = has_bristle_ ? 0.0 : load_friction_share_ * level(s0.position_m, 0);
    const double motor_level = (1 - load_friction_share_) * level(s0.motor_position_m, 0);
    if (joined) {
      if (cart_sign == 0) {
        cart_stuck = motor_stuck = std::abs(net.cart) <= cart_level + motor_level && !has_bristle_;
        cart_sign = motor_sign = sign_of(net.cart);
      }
    } else {
      if (cart_sign == 0) {
        cart_stuck = std::abs(net.cart) * load_share_ <= cart_level && cart_level > 0;
        cart_sign = sign_of(net.cart);
      }
      if (motor_sign == 0) {
        motor_stuck = std::abs(net.motor) * (1 - load_share_) <= motor_level && motor_level > 0;
        motor_sign = sign_of(net.motor);
      }
    }
    const auto rates = [&](const PlantState& s) {
      Rates r = two_mass_rates(s, cart_sign, motor_sign);
      if (cart_stuck) r.cart = 0;
      if (motor_stuck) r.motor = 0;
      return r;
    };
    const auto moved = [&](const PlantState& from, double vc, double vm, Rates r, double h) {
      PlantState s = s0;
      s.position_m = from.position_m + h * vc;
      s.motor_position_m = from.motor_position_m + h * vm;
      s.velocity_m_per_s = from.velocity_m_per_s + h * r.cart;
      s.motor_velocity_m_per_s = from.motor_velocity_m_per_s + h * r.motor;
      s.time_s = from.time_s + h;
      return s;
    };
    const Rates k1 = rates(s0);
    const auto step = [&](double h) {
      const PlantState s2 = moved(s0, s0.velocity_m_per_s, s0.motor_velocity_m_per_s, k1, 0.5 * h);
      const Rates k2 = rates(s2);
      const PlantState s3 = moved(s0, s2.velocity_m_per_s, s2.motor_velocity_m_per_s, k2, 0.5 * h);
      const Rates k3 = rates(s3);
      const PlantState s4 = moved(s0, s3.velocity_m_per_s, s3.motor_velocity_m_per_s, k3, h);
      const Rates k4 = rates(s4);
      const double vc = (s0.velocity_m_per_s + 2 * s2.velocity_m_per_s + 2 * s3.velocity_m_per_s +
                         s4.velocity_m_per_s) / 6;
      const double vm = (s0.motor_velocity_m_per_s + 2 * s2.motor_velocity_m_per_s +
                         2 * s3.motor_velocity_m_per_s + s4.motor_velocity_m_per_s) / 6;
      const Rates mean{(k1.cart + 2 * k2.cart + 2 * k3.cart + k4.cart) / 6,
                       (k1.motor + 2 * k2.motor + 2 * k3.motor + k4.motor) / 6};
      return moved(s0, vc, vm, mean, h);
    };
    const auto accept = [&](PlantState s) {
      if (has_bristle_) {
        const double most = load_friction_share_ * level(s.position_m, s.velocity_m_per_s) / bristle_stiffness_;
        s.bristle_m = std::clamp(s0.bristle_m + (s.position_m - s0.position_m), -most, most);
      }
      state_ = s;
    };
    PlantState s1 = step(left);
    // The earliest event inside this step, as a fraction of it.
    enum class Event { none, cart_stops, motor_stops, contact } first = Event::none;
    double theta = 1;
    if (event < kEventsPerStep) {
      const Rates end = rates(s1);
      const auto consider = [&](Event kind, double p0, double d0, double p1, double d1) {
        const double root = hermite_root(p0, d0 * left, p1, d1 * left);
        if (root <= theta) {
          theta = root;
          first = kind;
        }
      };
      if (!cart_stuck && !has_bristle_ && s0.velocity_m_per_s * s1.velocity_m_per_s < 0) {
        consider(Event::cart_stops, s0.velocity_m_per_s, k1.cart, s1.velocity_m_per_s, end.cart);
      }
      if (!joined && !motor_stuck && s0.motor_velocity_m_per_s * s1.motor_velocity_m_per_s < 0) {
        consider(Event::motor_stops, s0.motor_velocity_m_per_s, k1.motor, s1.motor_velocity_m_per_s, end.motor);
      }
      if (rigid_backlash_ && !joined) {
        const double half = 0.5 * gap_;
        const double x0 = s0.motor_position_m - s0.position_m, x1 = s1.motor_position_m - s1.position_m;
        const double w0 = s0.motor_velocity_m_per_s - s0.velocity_m_per_s;
        const double w1 = s1.motor_velocity_m_per_s - s1.velocity_m_per_s;
        for (const double side : {1.0, -1.0}) {
          const double p0 = std::min(side * x0 - half, 0.0), p1 = side * x1 - half;
          if (p1 > 0) consider(Event::contact, p0, side * w0, p1, side * w1);
        }
      }
    }
    if (first == Event::none) {
      accept(s1);
      break;
    }
    const double h = std::max(theta * left, 1e-12);
    s1 = step(h);
    if (first == Event::cart_stops) {
      s1.velocity_m_per_s = 0;
      if (joined) s1.motor_velocity_m_per_s = 0;
    } else if (first == Event::motor_stops) {
      s1.motor_velocity_m_per_s = 0;
    } else {
      join(s1);
    }
    accept(s1);
    left -= h;
  }
}

/// Inelastic impact: the masses go on together with their common momentum.
void Plant::join(PlantState& next) const noexcept {
  const double stretch = next.motor_position_m - next.position_m;
  next.contact = stretch > 0 ? 1 : -1;
  next.motor_position_m = next.position_m + 0.5 * gap_ * next.contact;
  const double v = load_share_ * next.velocity_m_per_s + (1 - load_share_) * next.motor_velocity_m_per_s;
  next.velocity_m_per_s = next.motor_velocity_m_per_s = v;
}

}  // namespace cartwright
