#pragma once

#include <optional>

#include "host/diagnose/search/explain.hpp"

namespace cartwright {

struct NextExperiment {
  std::string experiment;    ///< what to run, as `cartwright device run` takes it
  std::string separates;     ///< which candidates
  double expected_nats = 0;  ///< by which it would tell them apart, whichever of the two is true
  double chance = 0;         ///< that it will decide
};

/// The experiment that tells two explanations apart best. Each experiment of a menu that the rig can do
/// within its travel and voltage is simulated on the one, with its noise, and explained by the other with the
/// numbers of its effect fitted anew; then the other way round. What counts is the smaller of the two
/// differences in log-likelihood, and the chance that it exceeds what an effect must gain, from its spread
/// over blocks of time. None where nothing on the menu decides more often than not.
std::optional<NextExperiment> next_experiment(const Rig& rig, const Explanation& one,
                                              const Explanation& other, const SessionFacts& facts,
                                              const FitOptions& options, unsigned threads);

}  // namespace cartwright
