#pragma once

#include <cstdint>
#include <vector>

#include "host/diagnose/search/explain.hpp"

namespace cartwright::blind {

/// What looking everywhere finds where nothing is. The nominal model is refitted to a session that hides
/// nothing, the session simulated again from what was found (surrogate.hpp: same experiments, fitted
/// disturbance and reading noise, rounded to counts), and each such surrogate put through the whole search:
/// refit, screening, scans, fits of the most promising terms. Returns the greatest gain of each, in nats net
/// of the price of its numbers: what `kLeastGain` has to be beyond.
std::vector<double> greatest_gains_of_nothing(const Session& clean, const Model& nominal,
                                              std::size_t surrogates, std::uint64_t seed);

}  // namespace cartwright::blind
