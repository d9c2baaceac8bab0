// Two masses whose forces are linear between events, or taken as linear for a step: the state after a step is
// a Taylor series, and events are roots along it.
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "common/model/plant_step.hpp"

namespace cartwright {
namespace {

/// Terms are left out that are less than this part of the motion.
constexpr double kSeriesError = 1e-9;
constexpr std::size_t kMostTerms = 24;
/// An event is located to this part of the step.
constexpr double kRootWidth = 1e-9;
constexpr int kMostRootSteps = 60;

/// A number for the cart and one for the motor: positions, velocities, accelerations, forces.
struct Both {
  double cart = 0, motor = 0;
};

/// The same, to reckon with both at once.
using Lanes [[gnu::vector_size(16)]] = double;

Lanes lanes(const Both& both) {
  return Lanes{both.cart, both.motor};
}

Both both(Lanes of) {
  return {of[0], of[1]};
}

Lanes swapped(Lanes of) {
  return __builtin_shufflevector(of, of, 1, 0);
}

struct Motion {
  Both y, v;
  double s = 0;  ///< time into the step
};

struct Series {
  std::array<double, kMostTerms + 2> inverse{};  // 1/n
  std::array<double, kMostTerms + 1> reach{};  // of n terms: the w h at which (w h)^(n+1)/(n+1)! is the error

  Series() {
    double log_factorial = 0;
    inverse[1] = 1;
    for (std::size_t n = 1; n <= kMostTerms; ++n) {
      const double next = static_cast<double>(n + 1);
      log_factorial += std::log(next);
      inverse[n + 1] = 1 / next;
      reach[n] = std::exp((std::log(kSeriesError) + log_factorial) / next);
    }
  }
};
const Series kSeries;

/// How many terms the series of a motion takes for a step, by its fastest rate times the step.
std::size_t series_terms(double rate_times_step) {
  std::size_t n = 1;
  while (n < kMostTerms && kSeries.reach[n] < rate_times_step) ++n;
  return n;
}

/// Of the time into a step: sum of c[n] x^n.
struct Polynomial {
  std::array<double, kMostTerms + 2> c{};  // zero beyond the degree
  std::size_t degree = 0;

  /// Even and odd powers side by side, since each product waits for the one before it.
  double operator()(double x) const {
    const double square = x * x;
    const std::size_t pairs = degree / 2;
    double even = c[2 * pairs], odd = c[2 * pairs + 1];
    for (std::size_t n = pairs; n-- > 0;) {
      even = even * square + c[2 * n];
      odd = odd * square + c[2 * n + 1];
    }
    return even + x * odd;
  }
};

/// The drive during a step: at_start + slope s.
struct DriveLine {
  double at_start, slope;
};

/// How friction and contact act until the next event, and what of the series stays the same until then.
struct LinearMode {
  Both friction;  // that slides: level times the sign of the motion
  bool cart_stuck = false, motor_stuck = false;
  int contact = 0;
  bool coupled = false;   // the masses act on each other
  std::size_t terms = 0;  // of the series
  Lanes per_mass{};       // zero for what is stuck
  Lanes spring{}, damper{}, damping{};
};

enum class LinearEvent { none, cart_stops, motor_stops, cart_starts, motor_starts, touch, part, press_turns };
/// An event known when this is compiled: asked for at every step, one that is not would cost more than the
/// step.
template <LinearEvent event>
using Which = std::integral_constant<LinearEvent, event>;

/// What the masses do to each other, across a gap or not.
struct Coupling {
  double stiffness, damping, gap;

  /// The force on the cart if they do.
  double press(const Motion& at, int contact) const {
    return stiffness * (at.y.motor - at.y.cart - 0.5 * gap * contact) + damping * (at.v.motor - at.v.cart);
  }

  /// With a gap the parts push and never pull.
  bool acts(const Motion& at, int contact) const {
    return gap == 0 || (contact != 0 && contact * press(at, contact) > 0);
  }
};

class LinearPair {
 public:
  /// Linear from `now` on; `place` and `time_s` are half way through the step.
  LinearPair(const PlantTerms& terms, const Coupling& coupling, const Motion& now, const DriveLine& drive,
             double push, const Both& place, double time_s)
      : coupling_(coupling),
        inverse_mass_{1 / terms.load_share, 1 / (1 - terms.load_share)},
        outer_{terms.pushes(place.cart, time_s) + push, drive.at_start},
        drive_slope_(drive.slope) {
    const Resistance cart =
        resistance(terms, now.v.cart, place.cart, terms.load_damping_share, terms.load_friction_share);
    const Resistance motor = resistance(terms, now.v.motor, place.motor, 1 - terms.load_damping_share,
                                        1 - terms.load_friction_share);
    outer_.cart -= cart.at_zero;
    outer_.motor -= motor.at_zero;
    damping_ = {cart.slope, motor.slope};
    level_ = {cart.level, motor.level};
    if (!terms.has_current_limit) return;
    if (terms.over_current(drive.at_start, now.v.motor) < 0) {
      damping_.motor += terms.viscous;
    } else {
      const double side = sign_of(drive.at_start - terms.viscous * now.v.motor);
      outer_.motor += side * terms.current_limit - drive.at_start;
      drive_slope_ = 0;
    }
  }

  LinearMode mode(const Motion& at, int contact, bool coupled, std::size_t terms) const {
    LinearMode m;
    m.contact = contact;
    m.coupled = coupled;
    m.terms = terms;
    const Both net = forces(at, m);
    const auto decide = [](double v, double force, double level, double& friction, bool& stuck) {
      stuck = v == 0 && level > 0 && std::abs(force) <= level;
      friction = stuck ? 0 : level * sign_of(v != 0 ? v : force);
    };
    decide(at.v.cart, net.cart, level_.cart, m.friction.cart, m.cart_stuck);
    decide(at.v.motor, net.motor, level_.motor, m.friction.motor, m.motor_stuck);
    m.per_mass = Lanes{m.cart_stuck ? 0 : inverse_mass_.cart, m.motor_stuck ? 0 : inverse_mass_.motor};
    m.spring = (coupled ? coupling_.stiffness : 0) * m.per_mass;
    m.damper = (coupled ? coupling_.damping : 0) * m.per_mass;
    m.damping = lanes(damping_) * m.per_mass + m.damper;
    return m;
  }

  /// The motion h later.
  Motion after(const Motion& at, const LinearMode& mode, double h) const {
    Lanes y = lanes(at.y), v = lanes(at.v);
    double weight = 1;
    derivatives(at, mode, [&](std::size_t n, Lanes dy, Lanes dv) {
      weight *= h * kSeries.inverse[n];
      y += weight * dy;
      v += weight * dv;
    });
    return {both(y), both(v), at.s + h};
  }

  /// `past` as a polynomial of the time after `at`: it is a line in the motion, so that each coefficient of
  /// the motion gives one of it.
  template <LinearEvent event>
  Polynomial past_along(const Motion& at, const LinearMode& mode, const Motion& end) const {
    const double still = *past<event>(Motion{}, mode, end);
    Polynomial along{{*past<event>(at, mode, end)}, mode.terms};
    double weight = 1;
    derivatives(at, mode, [&](std::size_t n, Lanes dy, Lanes dv) {
      weight *= kSeries.inverse[n];
      along.c[n] = weight * (*past<event>({both(dy), both(dv), n == 1 ? 1.0 : 0.0}, mode, end) - still);
    });
    return along;
  }

  /// Greater than zero once the event has happened; none where it cannot. `end` of the step tells to which
  /// side it does.
  template <LinearEvent event>
  std::optional<double> past(const Motion& at, const LinearMode& mode, const Motion& end) const {
    const bool gap = coupling_.gap > 0;
    if constexpr (event == LinearEvent::cart_stops) {
      if (mode.friction.cart != 0) return -mode.friction.cart * at.v.cart;
    } else if constexpr (event == LinearEvent::motor_stops) {
      if (mode.friction.motor != 0) return -mode.friction.motor * at.v.motor;
    } else if constexpr (event == LinearEvent::cart_starts) {
      if (mode.cart_stuck) return sign_of(forces(end, mode).cart) * forces(at, mode).cart - level_.cart;
    } else if constexpr (event == LinearEvent::motor_starts) {
      if (mode.motor_stuck) return sign_of(forces(end, mode).motor) * forces(at, mode).motor - level_.motor;
    } else if constexpr (event == LinearEvent::touch) {
      if (gap && mode.contact == 0)
        return sign_of(end.y.motor - end.y.cart) * (at.y.motor - at.y.cart) - 0.5 * coupling_.gap;
    } else if constexpr (event == LinearEvent::part) {
      if (gap && mode.contact != 0) return 0.5 * coupling_.gap - mode.contact * (at.y.motor - at.y.cart);
    } else if constexpr (event == LinearEvent::press_turns) {
      if (gap && mode.contact != 0)
        return (mode.coupled ? -1 : 1) * mode.contact * coupling_.press(at, mode.contact);
    }
    return {};
  }

 private:
  /// Calls visit(n, y^(n), v^(n)) for every term of the series: each derivative follows from the one before
  /// it as accelerations do from the state.
  template <typename Visit>
  void derivatives(const Motion& at, const LinearMode& mode, const Visit& visit) const {
    const Lanes spring = mode.spring, damper = mode.damper, damping = mode.damping;
    const Both net = forces(at, mode);
    Lanes dy = lanes(at.v);
    Lanes dv = Lanes{net.cart - mode.friction.cart, net.motor - mode.friction.motor} * mode.per_mass;
    Lanes slope = {0, drive_slope_ * mode.per_mass[1]};
    for (std::size_t n = 1;; ++n) {
      visit(n, dy, dv);
      if (n == mode.terms) break;
      const Lanes next = (spring * (swapped(dy) - dy) - damping * dv) + damper * swapped(dv) + slope;
      slope = Lanes{};
      dy = dv;
      dv = next;
    }
  }

  /// What opposes one mass: at_zero + slope v, and a level of friction.
  struct Resistance {
    double at_zero, slope, level;
  };

  static Resistance resistance(const PlantTerms& terms, double v, double y, double damping_share,
                               double friction_share) {
    PlantTerms::Tangent damping = terms.damping_tangent(v);
    if (terms.has_current_limit) damping.slope -= terms.viscous;  // back-EMF is the motor's alone
    const PlantTerms::Tangent level = terms.level_tangent(y, v);
    return {damping_share * damping.at_zero, damping_share * damping.slope + friction_share * level.slope,
            friction_share * level.at_zero};
  }

  /// Without friction.
  Both forces(const Motion& at, const LinearMode& mode) const {
    const double coupling = mode.coupled ? coupling_.press(at, mode.contact) : 0;
    return {outer_.cart - damping_.cart * at.v.cart + coupling,
            outer_.motor + drive_slope_ * at.s - damping_.motor * at.v.motor - coupling};
  }

  const Coupling& coupling_;
  Both inverse_mass_, outer_, damping_, level_;
  double drive_slope_;
};

/// How long until just past a root of `past`, which is greater than zero after h: the method of false
/// position in its Illinois form. What is zero at the start has just happened, and happens again only after
/// it was below zero.
double root_after(const Polynomial& past, double h) {
  double low = 0, below = past(0), high = h, above = past(h);
  for (double inside = 0.5 * h; below >= 0; inside *= 0.5) {
    if (inside < kRootWidth * h) return std::max(inside, kLeastAdvance_s);
    const double value = past(inside);
    (value < 0 ? low : high) = inside;
    (value < 0 ? below : above) = value;
  }
  int last_side = 0;
  for (int i = 0; i < kMostRootSteps && high - low > kRootWidth * h; ++i) {
    // A little beyond where the line crosses, so that the root ends up enclosed.
    const double crossing = low + (high - low) * below / (below - above);
    const double x = std::min(std::max(crossing, low + 0.25 * kRootWidth * h), high - 0.25 * kRootWidth * h);
    const double value = past(x);
    if (value > 0) {
      high = x, above = value;
      if (last_side > 0) below *= 0.5;
      last_side = 1;
    } else {
      low = x, below = value;
      if (last_side < 0) above *= 0.5;
      last_side = -1;
    }
  }
  return std::max(high, kLeastAdvance_s);
}

}  // namespace

void Plant::hold_two_masses_linear(double duration_s) noexcept {
  Motion now{{state_.position_m, state_.motor_position_m},
             {state_.velocity_m_per_s, state_.motor_velocity_m_per_s}};
  const Coupling coupling{terms_.coupling_stiffness, terms_.coupling_damping, terms_.gap};
  double left = duration_s;
  int events = 0;
  while (left > kLeastAdvance_s) {
    const bool coupled = coupling.acts(now, state_.contact);
    double h = left / steps_over(left, coupled ? step_s_ : apart_step_s_);
    const std::size_t terms = series_terms((coupled ? terms_.series_rate : terms_.apart_rate) * h);
    Drive d = drive(h);
    const double mean = d.middle + (d.start - 2 * d.middle + d.end) / 6;
    const LinearPair pair(
        terms_, coupling, now, {mean - 0.5 * (d.end - d.start), (d.end - d.start) / h}, extra_push_,
        {now.y.cart + 0.5 * h * now.v.cart, now.y.motor + 0.5 * h * now.v.motor}, state_.time_s + 0.5 * h);
    const LinearMode mode = pair.mode(now, state_.contact, coupled, terms);
    Motion next = pair.after(now, mode, h);
    LinearEvent first = LinearEvent::none;
    const auto consider = [&]<LinearEvent event>(Which<event>) {
      const auto at_end = pair.past<event>(next, mode, next);
      if (!at_end || !(*at_end > 0)) return;
      first = event;
      if (events >= kEventsPerStep) return;  // too many to locate: it happens at the end
      h = root_after(pair.past_along<event>(now, mode, next), h);
      next = pair.after(now, mode, h);
      d = drive(h);
    };
    consider(Which<LinearEvent::cart_stops>{});
    consider(Which<LinearEvent::motor_stops>{});
    consider(Which<LinearEvent::cart_starts>{});
    consider(Which<LinearEvent::motor_starts>{});
    consider(Which<LinearEvent::touch>{});
    consider(Which<LinearEvent::part>{});
    consider(Which<LinearEvent::press_turns>{});
    events = first == LinearEvent::none ? 0 : events + 1;
    if (first == LinearEvent::cart_stops) next.v.cart = 0;
    if (first == LinearEvent::motor_stops) next.v.motor = 0;
    if (first == LinearEvent::touch) state_.contact = next.y.motor > next.y.cart ? 1 : -1;
    if (first == LinearEvent::touch || first == LinearEvent::part)
      next.y.motor = next.y.cart + 0.5 * terms_.gap * state_.contact;
    if (first == LinearEvent::part) state_.contact = 0;
    now = next;
    now.s = 0;
    state_.armature_V = d.armature_V;
    state_.time_s += h;
    left -= h;
  }
  state_.position_m = now.y.cart;
  state_.motor_position_m = now.y.motor;
  state_.velocity_m_per_s = now.v.cart;
  state_.motor_velocity_m_per_s = now.v.motor;
}

}  // namespace cartwright
