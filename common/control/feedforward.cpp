#include "common/control/feedforward.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

/// The model with nothing but what the feed-forward inverts.
Model inverted_part(const Model& model) {
  Model part = model;
  for (const Term term : without_inverse(model)) part.remove(term);
  return part;
}

}  // namespace

double mean_direction(const ReferenceMotion& reference, double period_s) noexcept {
  const double change = 0.5 * period_s * std::abs(reference.acceleration_m_per_s2);
  if (std::abs(reference.velocity_m_per_s) >= change) return sign_of(reference.velocity_m_per_s);
  return reference.velocity_m_per_s / change;
}

FeedForward::FeedForward(const Model& model, double period_s)
    : terms_(inverted_part(model), false), period_s_(period_s) {}

double FeedForward::drive_V(const ReferenceMotion& reference) const noexcept {
  if (!(terms_.beta > 0)) return 0;
  const double y = reference.position_m, v = reference.velocity_m_per_s;
  return (reference.acceleration_m_per_s2 + terms_.damping(v) +
          terms_.level(y, v) * mean_direction(reference, period_s_) - terms_.pushes(y, 0)) /
         terms_.beta;
}

double FeedForward::through_amplifier_V(double drive_V) const noexcept {
  const double side = sign_of(drive_V);
  return drive_V / (1 + 0.5 * terms_.gain_difference * side) + terms_.dead_zone * side;
}

bool has_inverse(Term term) {
  switch (term) {
    case Term::viscous_friction:
    case Term::coulomb_friction:
    case Term::exponential_damping:
    case Term::stribeck_friction:
    case Term::constant_force:
    case Term::asymmetric_viscous_friction:
    case Term::position_dependent_friction:
    case Term::cogging:
    case Term::input_dead_zone:
    case Term::cable_spring:
    case Term::quadratic_drag:
    case Term::amplifier_gain_asymmetry:
      return true;
    default:
      return false;
  }
}

std::vector<Term> without_inverse(const Model& model) {
  std::vector<Term> out;
  for (const TermInfo& term : terms()) {
    if (model.has(term.id) && !has_inverse(term.id)) out.push_back(term.id);
  }
  return out;
}

}  // namespace cartwright
