#pragma once

#include <string>

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// Effects that were found fit the one-step errors; an explanation must also predict. In words, why they do
/// not, after "with it"; empty where they do. They do not where windows are predicted worse
///
/// - than by a cart without forces, which keeps its speed;
/// - surely and by half, on what was used or was not (which may be empty), than by the nominal model as it
/// was
///   given: then the noise took in what is missing.
std::string predicts_no_better(const Diagnosis& diagnosis, const Model& nominal, const Session& used,
                               const Session& unseen, unsigned threads);

}  // namespace cartwright
