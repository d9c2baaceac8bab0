#pragma once

#include <vector>

#include "common/model/plant_terms.hpp"

namespace cartwright {

/// Where the reference is in the middle of a hold, and how it moves there.
struct ReferenceMotion {
  double position_m = 0, velocity_m_per_s = 0, acceleration_m_per_s2 = 0;
};

/// Mean of sgn v over a hold of length T during which v runs straight: sat(v / (|a| T/2)). At the turn of a
/// reference friction changes sign inside the hold; the mean is what a held voltage can do about it. Zero at
/// rest, where friction takes up whatever acts.
double mean_direction(const ReferenceMotion& reference, double period_s) noexcept;

/// The voltage that moves a model along a reference: the model's equation solved for u,
///
///     u = M((a_r + damping(v_r) + level(r, v_r) sgn v_r - pushes(r)) / beta)          [V]
///
/// with the inverse M of the amplifier's map (gain asymmetry, dead zone). Everything is taken from the
/// reference and nothing from a reading, so that no noise comes in and no loop is closed. Terms without such
/// an inverse are left out: `without_inverse`. No allocation, no exception in `voltage_V`.
class FeedForward {
 public:
  FeedForward() : FeedForward(Model(0), 0) {}
  /// A model whose voltage gain is not positive gives zero volts.
  FeedForward(const Model& model, double period_s);

  double voltage_V(const ReferenceMotion& reference) const noexcept {
    return through_amplifier_V(drive_V(reference));
  }

  bool has_model() const noexcept { return terms_.beta > 0; }

  /// The voltage that must act, before M.
  double drive_V(const ReferenceMotion& reference) const noexcept;
  /// The command that makes a voltage act, M.
  double through_amplifier_V(double drive_V) const noexcept;

 private:
  PlantTerms terms_;
  double period_s_;
};

/// Whether the feed-forward knows what to do about a term. Not: limits (saturation, current limit), what asks
/// for the reference's future (delay, lag), hidden states (backlash, coupling, bristle, heating), the
/// encoder's own errors and a push that only one recording had.
bool has_inverse(Term term);

/// The terms of a model that the feed-forward leaves out, in the vocabulary's order.
std::vector<Term> without_inverse(const Model& model);

}  // namespace cartwright
