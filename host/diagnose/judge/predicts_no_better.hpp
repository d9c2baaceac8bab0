#pragma once

#include <string>
#include <vector>

#include "host/diagnose/diagnosis.hpp"
#include "host/evaluate/replay.hpp"

namespace cartwright {

/// Errors of the same windows, predicted by the nominal model as it was given and by the one with effects.
struct WindowErrors {
  std::vector<SquaredError> nominal, with_effects;
};

/// Effects that were found fit the one-step errors; an explanation must also predict. In words, why they do
/// not, after "with it"; empty where they do. They do not where windows are predicted worse
///
/// - than by a cart without forces, which keeps its speed;
/// - by half, and surely, than by the nominal model as it was given, on what was used or on what was not (if
///   anything): then the noise took in what is missing.
std::string predicts_no_better(const Diagnosis& diagnosis, const WindowErrors& used,
                               const WindowErrors& unseen);

}  // namespace cartwright
