#pragma once

#include <string>

#include "tests/blind/baselines/one_round.hpp"

namespace cartwright::blind {

using Names = std::vector<std::string>;

/// Most gain without rules. The term whose fit gains most over the refitted nominal model is named whenever
/// it gains anything: nothing is asked of the size of the gain, of its numbers or of what is left. It names
/// one term and never refuses.
Names most_gain(const OneRound& first);

/// Bayesian information criterion, every row an independent reading: a term is worth it if it lowers
///
///     BIC = -2 log L + k log N        (Schwarz 1978; k free numbers, N rows)
///
/// The best term is added, and a second on top of it, as stepwise regression does. The likelihood and the
/// fits are the product's own, one-step errors under a fitted noise, so what this baseline lacks are the
/// rules alone: the price of looking in many places, plausibility, adequacy, refusal.
Names stepwise_bic(const Session& session, const OneRound& first);

/// The same criterion on what most people would fit: errors of 0.5 s windows simulated from the recorded
/// voltage, start states fitted, taken for independent normal readings. One term.
Names bic_of_windows(const Session& session, const OneRound& first);

/// Single-split validation. Every other recording is fitted, and the term with the least window error on the
/// rest is named, if that is less than the refitted nominal model's.
Names single_split(const Session& session, const Model& nominal);

}  // namespace cartwright::blind
