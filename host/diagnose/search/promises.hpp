#pragma once

#include <vector>

#include "host/diagnose/search/screen.hpp"

namespace cartwright {

/// Errors beyond this many noise sizes count linearly (FitOptions::outlier_m).
inline constexpr double kOutlierOverNoise = 6.0;

/// Whether a term parts the cart into two masses; to fit one costs ten times the time of any other.
bool two_masses(Term term);

/// What every term of the vocabulary that `base` lacks promises: fixed starts (screen.hpp), periods and
/// pushes (scan.hpp). Greatest promise first. Gaps and lost counts take more than a linear regression and are
/// looked for apart.
std::vector<Promise> all_promises(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads);

}  // namespace cartwright
