#pragma once

#include <optional>
#include <vector>

#include "host/diagnose/fit/candidates.hpp"

namespace cartwright {

/// One start of one candidate and what it promises.
struct Promise {
  Term term;
  Model start;
  std::vector<FreeParameter> free;  ///< of the whole model
  double log_likelihood_gain = 0;   ///< predicted by linear regression, nominal numbers refitted alongside
  std::optional<NoiseModel> noise = {};  ///< where the start has one of its own
};

/// Predicts, without fitting, how much each candidate start would gain over `base`: its errors differ from
/// the base's by a column; the base's own Jacobian is projected out, and the column's best multiple within
/// [0, most] (or of either sign where the physics has none) is taken. One pass per start. Strongest first.
std::vector<Promise> screen(const Session& session, const Fit& base, const std::vector<Candidate>& list,
                            const FitOptions& options, unsigned threads);

}  // namespace cartwright
