#include <cmath>

#include "common/model/hermite_root.hpp"
#include "common/model/plant_step.hpp"

namespace cartwright {
namespace {

/// Cart and motor at one moment.
struct Pair {
  double cart, motor, cart_v, motor_v;
};

struct Rates {
  double cart, motor;
};

/// How friction and contact act during one step; fixed until the next event.
struct Mode {
  double cart_sign = 0, motor_sign = 0;
  bool cart_stuck = false, motor_stuck = false;
  bool elastic = false;  // the cart's bristle, before breakaway
  double bristle_m = 0;  // its deflection at the start of the step
  double start_m = 0;    // and where the cart was then
  int contact = 0;
  Rates force{};  // at the start, without sliding friction and rigid contact
};

/// The two masses of a model, with the pushes of one step.
class TwoMasses {
 public:
  TwoMasses(const PlantTerms& terms, double extra_push) : p_(terms), extra_push_(extra_push) {}

  bool joined(const Mode& mode) const { return p_.rigid_backlash && mode.contact != 0; }
  double cart_level(const Pair& s) const { return p_.load_friction_share * p_.level(s.cart, s.cart_v); }
  double motor_level(const Pair& s) const {
    return (1 - p_.load_friction_share) * p_.level(s.motor, s.motor_v);
  }

  /// Force of a coupling on the load. With a gap the parts push and never pull.
  double coupling(const Pair& s, int contact) const {
    if (p_.rigid_backlash) return 0;
    const double stretch = s.motor - s.cart;
    const double rate = p_.coupling_damping * (s.motor_v - s.cart_v);
    if (p_.gap == 0) return p_.coupling_stiffness * stretch + rate;
    if (contact == 0) return 0;
    const double force = p_.coupling_stiffness * (stretch - 0.5 * p_.gap * contact) + rate;
    return contact > 0 ? std::max(force, 0.0) : std::min(force, 0.0);
  }

  /// Forces on cart and motor without sliding friction and without rigid contact.
  Rates forces(const Pair& s, double time_s, double drive, const Mode& mode) const {
    const double coupled = coupling(s, mode.contact);
    double cart = p_.pushes(s.cart, time_s) + extra_push_ - p_.load_damping(s.cart_v) + coupled;
    if (mode.elastic) cart -= p_.bristle_stiffness * (mode.bristle_m + (s.cart - mode.start_m));
    return {cart, p_.driven(drive, s.motor_v, 1 - p_.load_damping_share) - coupled};
  }

  Rates accelerations(const Pair& s, double time_s, double drive, const Mode& mode) const {
    return under(forces(s, time_s, drive, mode), s, mode);
  }

  /// Accelerations under these forces, sliding friction and rigid contact added.
  Rates under(Rates f, const Pair& s, const Mode& mode) const {
    if (mode.cart_sign != 0) f.cart -= mode.cart_sign * cart_level(s);
    if (mode.motor_sign != 0) f.motor -= mode.motor_sign * motor_level(s);
    if (joined(mode)) {
      const double a = mode.cart_stuck ? 0 : f.cart + f.motor;
      return {a, a};
    }
    return {mode.cart_stuck ? 0 : f.cart / p_.load_share,
            mode.motor_stuck ? 0 : f.motor / (1 - p_.load_share)};
  }

  /// By how much rigid contact would have to pull: the masses part where this turns positive. At a standstill
  /// each mass would start, if at all, the way its own net force points.
  double parting(const Pair& s, double time_s, double drive, const Mode& mode) const {
    Rates f = forces(s, time_s, drive, mode);
    if (s.cart_v == 0) {
      const auto beyond = [](double force, double level) {
        return std::abs(force) > level ? force - std::copysign(level, force) : 0.0;
      };
      f.cart = mode.elastic ? f.cart : beyond(f.cart, cart_level(s));
      f.motor = beyond(f.motor, motor_level(s));
    } else {
      const double sign = sign_of(s.cart_v);
      if (!mode.elastic) f.cart -= sign * cart_level(s);
      f.motor -= sign * motor_level(s);
    }
    return mode.contact * (f.cart / p_.load_share - f.motor / (1 - p_.load_share));
  }

  /// By how much the net force on a mass at rest exceeds what friction can hold: it starts where this turns
  /// positive.
  double cart_excess(const Pair& s, double time_s, double drive, const Mode& mode) const {
    const Rates f = forces(s, time_s, drive, mode);
    if (!joined(mode)) return std::abs(f.cart) - cart_level(s);
    return std::abs(f.cart + f.motor) - (mode.elastic ? 0 : cart_level(s)) - motor_level(s);
  }
  double motor_excess(const Pair& s, double time_s, double drive, const Mode& mode) const {
    return std::abs(forces(s, time_s, drive, mode).motor) - motor_level(s);
  }

  Mode mode(const Pair& s, double time_s, double drive, double bristle_m, int contact) const {
    Mode m;
    m.contact = contact;
    m.start_m = s.cart;
    if (p_.has_bristle) {
      const BristleMode bristle =
          bristle_mode(bristle_m, s.cart_v, cart_level(s) / p_.bristle_stiffness, [&] {
            const Rates f = forces(s, time_s, drive, m);
            return (joined(m) ? f.cart + f.motor : f.cart) / p_.bristle_stiffness;
          });
      m.elastic = bristle.elastic;
      m.bristle_m = bristle.deflection_m;
      m.cart_sign = bristle.elastic ? 0 : sign_of(bristle.deflection_m);
    }
    if (joined(m) && parting(s, time_s, drive, m) > 0) m.contact = 0;
    const Rates f = forces(s, time_s, drive, m);
    const bool both = joined(m);
    if (!p_.has_bristle) m.cart_sign = sign_of(s.cart_v);
    m.motor_sign = sign_of(s.motor_v);
    if (s.cart_v == 0 && !(p_.has_bristle && !both)) {
      const double held = both ? (m.elastic ? 0 : cart_level(s)) + motor_level(s) : cart_level(s);
      const double net = both ? f.cart + f.motor : f.cart;
      m.cart_stuck = held > 0 && std::abs(net) <= held;
      if (!p_.has_bristle) m.cart_sign = m.cart_stuck ? 0 : sign_of(net);
      if (both) {
        m.motor_stuck = m.cart_stuck;
        m.motor_sign = m.motor_stuck ? 0 : sign_of(net);
      }
    }
    if (!both && s.motor_v == 0) {
      const double held = motor_level(s);
      m.motor_stuck = held > 0 && std::abs(f.motor) <= held;
      m.motor_sign = m.motor_stuck ? 0 : sign_of(f.motor);
    }
    m.force = f;
    return m;
  }

 private:
  const PlantTerms& p_;
  double extra_push_;
};

enum class Event { none, cart_stops, motor_stops, cart_starts, motor_starts, breakaway, touch, part, corner };

/// The earliest of the events found inside a step, as a fraction of it.
struct Earliest {
  Event event = Event::none;
  double fraction = 1;

  /// The event happens where p passes from at most zero to above it.
  void consider(Event kind, double p0, double slope0, double p1, double slope1) {
    if (!(p1 > 0)) return;
    const double root = hermite_root(std::min(p0, 0.0), slope0, p1, slope1);
    if (root > fraction || (root == fraction && event != Event::none)) return;
    fraction = root;
    event = kind;
  }
  void consider(Event kind, double p0, double p1) {
    consider(kind, p0, p1 - std::min(p0, 0.0), p1, p1 - std::min(p0, 0.0));
  }
};

}  // namespace

void Plant::hold_two_masses(double duration_s) noexcept {
  const PlantTerms& p = terms_;
  const TwoMasses masses(p, extra_push_);
  const double half_gap = 0.5 * p.gap;
  double left = duration_s;
  for (int count = 0; left > kLeastAdvance_s; ++count) {
    const double t = state_.time_s;
    const Pair s0{state_.position_m, state_.motor_position_m, state_.velocity_m_per_s,
                  state_.motor_velocity_m_per_s};
    const Mode mode = masses.mode(s0, t, drive(left).start, state_.bristle_m, state_.contact);
    state_.contact = mode.contact;
    const bool joined = masses.joined(mode);
    const Rates k1 = masses.under(mode.force, s0, mode);
    Drive d{};
    const auto step = [&](double h) {
      d = drive(h);
      const auto moved = [&](const Pair& at, const Rates& a, double by) {
        return Pair{s0.cart + by * at.cart_v, s0.motor + by * at.motor_v, s0.cart_v + by * a.cart,
                    s0.motor_v + by * a.motor};
      };
      const Pair s2 = moved(s0, k1, 0.5 * h);
      const Rates k2 = masses.accelerations(s2, t + 0.5 * h, d.middle, mode);
      const Pair s3 = moved(s2, k2, 0.5 * h);
      const Rates k3 = masses.accelerations(s3, t + 0.5 * h, d.middle, mode);
      const Pair s4 = moved(s3, k3, h);
      const Rates k4 = masses.accelerations(s4, t + h, d.end, mode);
      const double w = h / 6;
      return Pair{s0.cart + w * (s0.cart_v + 2 * (s2.cart_v + s3.cart_v) + s4.cart_v),
                  s0.motor + w * (s0.motor_v + 2 * (s2.motor_v + s3.motor_v) + s4.motor_v),
                  s0.cart_v + w * (k1.cart + 2 * (k2.cart + k3.cart) + k4.cart),
                  s0.motor_v + w * (k1.motor + 2 * (k2.motor + k3.motor) + k4.motor)};
    };
    double h = left;
    Pair s1 = step(h);
    Earliest first;
    if (count < kEventsPerStep) {
      const auto end = [&] { return masses.accelerations(s1, t + h, d.end, mode); };
      if (p.breaks_at_rest && !mode.cart_stuck && !mode.elastic && mode.cart_sign * s1.cart_v < 0) {
        const double sign = -mode.cart_sign;
        first.consider(Event::cart_stops, sign * s0.cart_v, sign * k1.cart * h, sign * s1.cart_v,
                       sign * end().cart * h);
      }
      if (p.breaks_at_rest && !mode.motor_stuck && mode.motor_sign * s1.motor_v < 0 &&
          (!joined || mode.elastic)) {
        const double sign = -mode.motor_sign;
        first.consider(Event::motor_stops, sign * s0.motor_v, sign * k1.motor * h, sign * s1.motor_v,
                       sign * end().motor * h);
      }
      if (mode.cart_stuck) {
        first.consider(Event::cart_starts, masses.cart_excess(s0, t, d.start, mode),
                       masses.cart_excess(s1, t + h, d.end, mode));
      }
      if (mode.motor_stuck && !joined) {
        first.consider(Event::motor_starts, masses.motor_excess(s0, t, d.start, mode),
                       masses.motor_excess(s1, t + h, d.end, mode));
      }
      if (mode.elastic) {
        const double pull = mode.bristle_m + (s1.cart - s0.cart), side = sign_of(pull);
        const double over = side * pull - masses.cart_level(s1) / p.bristle_stiffness;
        if (side * s1.cart_v > 0) {
          first.consider(Event::breakaway,
                         side * mode.bristle_m - masses.cart_level(s0) / p.bristle_stiffness,
                         side * s0.cart_v * h, over, side * s1.cart_v * h);
        }
      }
      if (p.has_current_limit) {
        const double corner =
            sign_change(p.over_current(d.start, s0.motor_v), p.over_current(d.end, s1.motor_v));
        if (corner < first.fraction) first = {Event::corner, corner};
      }
      if (joined) {
        first.consider(Event::part, masses.parting(s0, t, d.start, mode),
                       masses.parting(s1, t + h, d.end, mode));
      } else if (p.gap > 0) {
        const double w0 = (s0.motor_v - s0.cart_v) * h, w1 = (s1.motor_v - s1.cart_v) * h;
        const double x0 = s0.motor - s0.cart, x1 = s1.motor - s1.cart;
        for (const int side : {1, -1}) {
          if (mode.contact == 0)
            first.consider(Event::touch, side * x0 - half_gap, side * w0, side * x1 - half_gap, side * w1);
          if (mode.contact == side)
            first.consider(Event::part, half_gap - side * x0, -side * w0, half_gap - side * x1, -side * w1);
        }
      }
    }
    if (first.event != Event::none) {
      h = std::min(left, std::max(first.fraction * left, kLeastAdvance_s));
      s1 = step(h);
    } else if (count >= kEventsPerStep && p.breaks_at_rest) {
      // Too many events to locate: what crossed zero stands still.
      if (mode.cart_sign * s1.cart_v < 0) first.event = Event::cart_stops;
      if (mode.motor_sign * s1.motor_v < 0) s1.motor_v = 0;
    }
    switch (first.event) {
      case Event::cart_stops:
        s1.cart_v = 0;
        if (joined) s1.motor_v = 0;
        break;
      case Event::motor_stops:
        s1.motor_v = 0;
        if (joined) s1.cart_v = 0;
        break;
      case Event::touch: {
        state_.contact = s1.motor > s1.cart ? 1 : -1;
        s1.motor = s1.cart + half_gap * state_.contact;
        if (p.rigid_backlash) {  // inelastic: the masses go on together with their common momentum
          s1.cart_v = s1.motor_v = p.load_share * s1.cart_v + (1 - p.load_share) * s1.motor_v;
        }
        break;
      }
      case Event::part:
        if (!p.rigid_backlash) {
          s1.motor = s1.cart + half_gap * state_.contact;
          state_.contact = 0;
        }
        break;
      default:
        break;
    }
    if (p.has_bristle) {
      state_.bristle_m = mode.elastic ? mode.bristle_m + (s1.cart - s0.cart)
                                      : mode.cart_sign * masses.cart_level(s1) / p.bristle_stiffness;
    }
    state_.position_m = s1.cart;
    state_.velocity_m_per_s = s1.cart_v;
    state_.motor_position_m = s1.motor;
    state_.motor_velocity_m_per_s = s1.motor_v;
    state_.armature_V = d.armature_V;
    state_.time_s += h;
    left -= h;
  }
}

}  // namespace cartwright
