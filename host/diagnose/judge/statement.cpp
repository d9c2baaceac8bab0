#include "host/diagnose/judge/statement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Less than this of the noise floor lengthens the windows' errors by half a percent.
constexpr double kHardlyMatters = 0.1;

std::string statement_of_cogging(const Model& m) {
  std::vector<std::string> waves;
  for (const PeriodicTerm& wave : kCoggingWaves) {
    if (m[wave.amplitude] == 0) continue;
    waves.push_back(
        fmt::format("+-{:.3g} m/s^2, repeating every {:.4g} mm", m[wave.amplitude], 1e3 * m[wave.period]));
  }
  return fmt::format("The motor cogs: {}.", fmt::join(waves, "; "));
}

}  // namespace

std::string statement(Term term, const Model& m) {
  const auto side = [](double value) { return value > 0 ? "+y" : "-y"; };
  switch (term) {
    case Term::viscous_friction:
      return fmt::format("Damping proportional to speed, {:.3g} m/s^2 per m/s.", m[P::viscous_coefficient]);
    case Term::coulomb_friction:
      return fmt::format(
          "Dry friction of {:.3g} m/s^2 opposes every motion and holds the cart still up to that.",
          m[P::coulomb_level]);
    case Term::exponential_damping:
      return fmt::format("Damping is {:.3g} 1/s higher at rest and falls off with speed over {:.3g} mm/s.",
                         m[P::exponential_alpha1], 1e3 / m[P::exponential_alpha2]);
    case Term::stribeck_friction:
      return fmt::format(
          "Friction is {:.3g} m/s^2 higher at rest; the excess is gone above about {:.3g} mm/s.",
          m[P::stribeck_excess], 2e3 * m[P::stribeck_speed]);
    case Term::constant_force:
      return fmt::format(
          "A constant push of {:.3g} m/s^2 towards {}: the track is tilted, the amplifier has an offset, or "
          "dry "
          "friction differs between directions (one and the same equation).",
          std::abs(m[P::constant_acceleration]), side(m[P::constant_acceleration]));
    case Term::asymmetric_viscous_friction:
      return fmt::format("Viscous friction is {:.3g} % higher towards {} than the other way.",
                         100 * std::abs(m[P::asymmetric_viscous_difference]),
                         side(m[P::asymmetric_viscous_difference]));
    case Term::position_dependent_friction:
      return fmt::format("The rail rubs at y = {:.4g} mm: {:.3g} m/s^2 of extra friction, {:.3g} mm wide.",
                         1e3 * m[P::spot_centre], m[P::spot_peak], 1e3 * m[P::spot_width]);
    case Term::cogging:
      return statement_of_cogging(m);
    case Term::backlash:
      return fmt::format("The motor turns {:.3g} mm before the cart follows, after every reversal.",
                         1e3 * m[P::backlash_gap]);
    case Term::input_dead_zone:
      return fmt::format("Commands within +-{:.3g} V give nothing; larger ones arrive that much smaller.",
                         m[P::dead_zone_half_width]);
    case Term::voltage_saturation:
      return fmt::format("The amplifier never delivers more than {:.4g} V.", m[P::saturation_limit]);
    case Term::current_limit:
      return fmt::format("The amplifier limits the current: drive less back-EMF never exceeds {:.4g} m/s^2.",
                         m[P::current_limit]);
    case Term::armature_lag:
      return fmt::format("The force follows the command with a first-order lag of {:.3g} ms.",
                         1e3 * m[P::armature_time_constant]);
    case Term::transport_delay:
      return fmt::format("The command takes {:.3g} ms to act.", 1e3 * m[P::transport_delay]);
    case Term::cable_spring:
      return fmt::format("A tether pulls the cart towards y = {:.3g} mm with {:.3g} m/s^2 per m.",
                         1e3 * m[P::spring_neutral], m[P::spring_stiffness]);
    case Term::quadratic_drag:
      return fmt::format("Drag grows with the square of speed, {:.3g} m/s^2 at 1 m/s.",
                         m[P::drag_coefficient]);
    case Term::flexible_coupling:
      return fmt::format("Motor and cart hang on a spring: a resonance at {:.4g} Hz, damping ratio {:.2g}.",
                         m[P::coupling_resonance], m[P::coupling_damping_ratio]);
    case Term::motor_heating:
      return fmt::format(
          "The voltage gain falls by {:.3g} % with a time constant of {:.3g} s in each recording.",
          100 * m[P::heating_gain_loss], m[P::heating_time_constant]);
    case Term::encoder_eccentricity:
      return fmt::format("The encoder reads +-{:.3g} um wrong, repeating every {:.4g} mm.",
                         1e6 * m[P::eccentricity_amplitude], 1e3 * m[P::eccentricity_period]);
    case Term::encoder_missed_counts:
      return fmt::format(
          "The encoder loses about {:.3g} counts {:.2g} times a second while faster than {:.3g} m/s.",
          m[P::missed_burst], m[P::missed_rate], m[P::missed_speed]);
    case Term::presliding_friction:
      return fmt::format(
          "Before it breaks away, friction gives like a spring of {:.3g} m/s^2 per mm{}.",
          1e-3 * m[P::presliding_stiffness],
          m[P::presliding_dahl_exponent] == 0
              ? ""
              : fmt::format(", and softens on the way there ({})",
                            m[P::presliding_damping_ratio] > 0 ? "LuGre's law" : "Dahl's law"));
    case Term::external_disturbance:
      return fmt::format(
          "Something pushed the cart in {} for {:.3g} s from t = {:.4g} s, {:.3g} m/s^2 at most.",
          m.disturbance_recording, m[P::disturbance_duration], m[P::disturbance_start],
          m[P::disturbance_peak]);
    case Term::amplifier_gain_asymmetry:
      return fmt::format("The amplifier's gain is {:.3g} % {} for positive commands than for negative ones.",
                         100 * std::abs(m[P::amplifier_gain_difference]),
                         m[P::amplifier_gain_difference] > 0 ? "higher" : "lower");
  }
  return {};
}

std::string names_of(const std::vector<Term>& terms) {
  std::string list;
  for (const Term term : terms) list += fmt::format("{}{}", list.empty() ? "" : ", ", info(term).name);
  return list;
}

std::string length_text(double length_m) {
  return length_m < 1e-3 ? fmt::format("{:.3g} um", 1e6 * length_m)
                         : fmt::format("{:.3g} mm", 1e3 * length_m);
}

std::string statement_of_windows(const Diagnosis& d) {
  return fmt::format("0.5 s windows, rms: nominal {}, refitted {}, with effects {}, noise floor {}.",
                     length_text(d.used.nominal), length_text(d.used.refitted),
                     length_text(d.used.with_effects), length_text(d.noise_floor_m));
}

std::string statement_of_left_over(const Unexplained& left) {
  const std::string where = left.curve.flat() ? "no axis shows it above chance"
                                              : fmt::format("most of it lies along {}", left.axis);
  return fmt::format("{:.0f} % of what is missing stays unexplained; {}.", 100 * left.share_left, where);
}

std::string statement_of_support(const Support& support, double noise_floor_m) {
  const std::size_t count = support.recordings.size();
  return fmt::format(
      "{} of {} recording{} so beyond chance; without it windows would be {} off instead of {}{}.",
      support.recordings_for(), count, count == 1 ? " says" : "s say", length_text(support.windows_without_m),
      length_text(support.windows_with_m),
      support.windows_moved_m() < kHardlyMatters * noise_floor_m ? ", so it hardly matters" : "");
}

std::string statement_of_next(const NextExperiment& next, bool more_is_missing) {
  return fmt::format("separates {}; chance that it decides{}: {:.0f} %.", next.separates,
                     more_is_missing ? ", were nothing else missing" : "", 100 * next.chance);
}

std::string statement_of_periods(const std::vector<double>& periods_m) {
  if (periods_m.empty()) return {};
  std::vector<std::string> words;
  for (const double period_m : periods_m) words.push_back(fmt::format("{:.4g} mm", 1e3 * period_m));
  return fmt::format(
      "A push that repeats every {} is left without a name; "
      "cogging would, or a screw or wheel that runs out of true.",
      fmt::join(words, ", every "));
}

}  // namespace cartwright
