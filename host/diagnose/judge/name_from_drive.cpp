#include "host/diagnose/judge/name_from_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/judge/statement.hpp"

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kMostLeft = 0.5;
constexpr double kClearlyBehind = 10;  // nats

Estimate scaled(const Estimate& e, double by) {
  return {by * e.value, by * e.low, by * e.high};
}

/// The dry friction that, with the nominal damping, opposes the speeds held as strongly as the drive says.
void set_friction(const DriveBalance& drive, Model& model) {
  if (!model.has(Term::coulomb_friction)) return;
  double speed = 0;
  for (const DriveWindow& w : drive.windows) speed += std::abs(w.speed_m_per_s);
  speed /= static_cast<double>(drive.windows.size());
  const double damping = model.has(Term::viscous_friction) ? model[P::viscous_coefficient] * speed : 0;
  model.set(P::coulomb_level, std::max(0.0, model[P::voltage_gain] * drive.friction_V - damping));
}

}  // namespace

bool names_cogging(const DriveBalance& drive) {
  return drive.share_left() <= kMostLeft;
}

void name_from_drive(const DriveBalance& drive, const Model& nominal, Diagnosis& d) {
  d.verdict = Verdict::missing_physics;
  d.model = nominal;
  set_friction(drive, d.model);
  Effect effect{Term::cogging, 0, {}, {}, {}, {}, 1 - drive.share_left(), 0, {}, "", {}};
  for (std::size_t i = 0; i < drive.held; ++i) {
    const PeriodicTerm& wave = kCoggingWaves[i];
    const DriveLine& line = drive.lines[i];
    // A push against the drive that balances it: half a turn on.
    const double half_turn = line.phase_rad.value > 0 ? -std::numbers::pi : std::numbers::pi;
    const Estimate phase{line.phase_rad.value + half_turn, line.phase_rad.low + half_turn,
                         line.phase_rad.high + half_turn};
    const Estimate amplitude = scaled(line.height_V, std::abs(nominal[P::voltage_gain]));
    effect.parameters.insert(
        effect.parameters.end(),
        {{wave.amplitude, amplitude}, {wave.period, line.period_m}, {wave.phase, phase}});
    d.model.set(wave.amplitude, amplitude.value);
    d.model.set(wave.period, line.period_m.value);
    d.model.set(wave.phase, phase.value);
    effect.gain += line.gain - 3 * kCostPerNumber;
  }
  effect.evidence.gain_nats = effect.gain;
  effect.evidence.margin_nats = drive.time_behind;
  effect.evidence.rivals = weight_of_rival(drive.time_behind);
  effect.evidence.share_left = drive.share_left();
  effect.confidence = confidence(effect.evidence);
  effect.statement = statement(Term::cogging, d.model);
  d.effects = {std::move(effect)};
  d.runner_up.clear();
  for (NominalParameter& p : d.parameters) p.refitted = {d.model[p.id]};
}

std::string statement_of_lines(const DriveBalance& drive) {
  return fmt::format(
      "Of {:.3g} V rms that the drive balances besides friction, lines over the way leave {:.3g} V in "
      "quarters "
      "of the way that they were not fitted to.",
      drive.unseen_missing_V, drive.unseen_left_V);
}

std::string statement_of_drive(const DriveBalance& drive) {
  std::string text =
      "A servo holds the speed here: nothing is predicted better than that it stays, and the drive only "
      "balances forces. " +
      statement_of_lines(drive) +
      " Accelerations are volts times the voltage gain as given, which such a session does not tell.";
  if (drive.time_behind < kClearlyBehind)
    text += " At one speed a push that repeats in time looks the same; a second speed would tell.";
  return text;
}

}  // namespace cartwright
