#pragma once

#include <algorithm>
#include <vector>

#include "host/diagnose/fit/fit.hpp"
#include "host/session/motion_range.hpp"

namespace cartwright {

/// What a session excites; start values and ranges of the candidates are set by it, never by guesses about
/// the cart.
struct SessionFacts : MotionRange {
  double count_m = 0;  ///< of the encoder; 0 where it is not known
  double sample_rate_hz = 1000;
  double most_voltage_V = 0;     ///< 99.9th percentile of |u|
  double typical_voltage_V = 0;  ///< root mean square
  double longest_recording_s = 0;
  /// What is fast is looked for where it lies on carts that are read at a kilohertz, and as many ticks of
  /// this rig away: a machine that is read more seldom may be slower, one read more often faster.
  double rate() const { return sample_rate_hz / 1000; }
  double slower() const { return std::min(1.0, rate()); }
  double faster() const { return std::max(1.0, rate()); }
  /// The least way to look for: a count, or where that is not known a ten thousandth of the travel.
  double least_way_m() const { return count_m > 0 ? count_m : 1e-4 * travel_m(); }
};
SessionFacts facts_of(const Session& session);

/// Physics that may have been left out: which numbers would be free and where to start them.
struct Candidate {
  Term term;
  std::vector<FreeParameter> free;  ///< of this term
  std::vector<std::vector<std::pair<Parameter, double>>> starts;
};

/// The free numbers of the terms a model already has.
std::vector<FreeParameter> free_parameters(const Model& model, const SessionFacts& facts);

/// How a number of the vocabulary moves in a fit.
FreeParameter free_parameter(Parameter parameter, const SessionFacts& facts, const Model& model);

/// Every term of the vocabulary that `model` lacks and that a fit from fixed start values can find. Periodic
/// effects, pushes and lost counts start from scans of the errors instead (scan.hpp).
std::vector<Candidate> candidates(const Model& model, const SessionFacts& facts);

/// `model` with a candidate's start values set.
Model with_start(Model model, const std::vector<std::pair<Parameter, double>>& start);

}  // namespace cartwright
