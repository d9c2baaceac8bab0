#include "host/diagnose/search/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/observe/observer.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

/// The lines of an encoder stand no nearer to their places than half a count: a smaller error is the encoder
/// itself, not the way it was mounted.
constexpr double kLeastEccentricity_counts = 0.5;

/// A winding 150 K above the room, the most that insulation of class H bears, has 1.6 times its resistance:
/// the gain is then 0.63 of what it was. Even small windings take a second to warm up.
constexpr double kMostHeating = 0.5;
constexpr double kFastestHeating_s = 0.5;

/// What is left, at the greatest speed or the far end of the way, of friction that was seen to fall off.
constexpr double kFallenOff = 0.02;

/// Friction that is extra at low speed or at a spot, and the only one, must fall off within the speeds and
/// the way of the session: else it is Coulomb's.
bool falls_off(const Model& model, Term effect, const SessionFacts& facts) {
  const auto square = [](double x) { return x * x; };
  if (model.has(Term::coulomb_friction)) return true;
  if (effect == Term::stribeck_friction)
    return std::exp(-square(facts.most_speed_m_per_s / model[Parameter::stribeck_speed])) < kFallenOff;
  const double centre_m = model[Parameter::spot_centre];
  const double far_m = std::max(centre_m - facts.position_low_m, facts.position_high_m - centre_m);
  return std::exp(-square(far_m / model[Parameter::spot_width]) / 2) < kFallenOff;
}

/// What is at its height before the errors of its recording count is a start state that does not fit, not a
/// push.
bool inside_its_recording(const Model& model, const Session& session) {
  const auto r = std::find_if(session.recordings.begin(), session.recordings.end(),
                              [&](const Recording& one) { return one.file == model.disturbance_recording; });
  if (r == session.recordings.end() || r->size() <= settling_rows(session.rig)) return false;
  const double start_s = model[Parameter::disturbance_start];
  const double duration_s = model[Parameter::disturbance_duration];
  return start_s >= r->t_s.front() && start_s + duration_s <= r->t_s.back() &&
         start_s + 0.5 * duration_s >= r->t_s[settling_rows(session.rig)];
}

/// Of two masses, not of one and next to nothing: where the smaller one's share is told to be hardly more
/// than its least, the coupling is a law for the motor alone. A share that is not told at all says nothing.
bool of_two_masses(const Fit& fit) {
  constexpr Parameter kShare = Parameter::coupling_load_share;
  const auto share =
      std::find_if(fit.free.begin(), fit.free.end(), [](const FreeParameter& p) { return p.id == kShare; });
  if (share == fit.free.end()) return true;
  const double from_bound = std::min(fit.model[kShare] - share->lower, share->upper - fit.model[kShare]);
  const double reach = normal(0.95) * fit.standard_error(kShare);
  return from_bound > reach || from_bound + reach > share->lower;
}

}  // namespace

double eccentricity_of(const Model& model) {
  return 2 * std::numbers::pi * std::abs(model[Parameter::eccentricity_amplitude]) /
         model[Parameter::eccentricity_period];
}

bool plausible(const Fit& fit, Term effect, const Session& session, const SessionFacts& facts) {
  for (const FreeParameter& p : fit.free) {
    const bool optional = info(p.id).default_value.has_value();  // rigid teeth are teeth
    if (info(p.id).term == effect && !optional && p.logarithmic && fit.at_bound(p.id)) return false;
  }
  const double count = session.rig.encoder_resolution_m;
  // A period that the way does not hold twice is not seen to repeat: any bend of a force would look like it.
  const double longest_m = facts.travel_m() / 2;
  switch (effect) {
    case Term::backlash:
      return fit.model[Parameter::backlash_gap] >= count;
    case Term::stribeck_friction:
    case Term::position_dependent_friction:
      return falls_off(fit.model, effect, facts);
    case Term::flexible_coupling:
      return of_two_masses(fit);
    case Term::cogging:
      return std::all_of(kCoggingWaves.begin(), kCoggingWaves.end(), [&](const PeriodicTerm& wave) {
        return fit.model[wave.amplitude] == 0 || fit.model[wave.period] <= longest_m;
      });
    case Term::encoder_eccentricity:
      return fit.model[Parameter::eccentricity_period] <= longest_m &&
             fit.model[Parameter::eccentricity_amplitude] >= kLeastEccentricity_counts * count &&
             eccentricity_of(fit.model) <= kMostEccentricity;
    case Term::motor_heating:
      return fit.model[Parameter::heating_gain_loss] <= kMostHeating &&
             fit.model[Parameter::heating_time_constant] >= kFastestHeating_s;
    case Term::external_disturbance:
      return inside_its_recording(fit.model, session);
    default:
      return true;
  }
}

}  // namespace cartwright
