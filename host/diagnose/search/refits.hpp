#pragma once

#include "host/diagnose/search/explanation.hpp"

namespace cartwright {

/// Options for a fit that only tells whether another to the end is worth its time.
FitOptions of_sketch(FitOptions options);

/// Contact comes and goes: the cost of a model with a gap has kinks, so slopes are taken over wider steps.
FitOptions with_kinks(const Model& model, FitOptions options);

/// A sketch, fitted to the end.
Fit finished(const Session& data, const Fit& sketch, const FitOptions& options);

/// An explanation refitted from where it is, one of its effects taken out.
Explanation doing_without(const Session& session, const Explanation& from, std::size_t effect,
                          const FitOptions& options);

/// An explanation refitted with the last effect of `rival` in the place of one of its own, which starts as it
/// was found; to the end only where a sketch scores more than `worth_finishing`.
Explanation in_place_of(const Session& session, const Explanation& from, std::size_t effect,
                        const Explanation& rival, double worth_finishing, const FitOptions& options);

/// An explanation with one of its effects told last, as if it had been found so.
Explanation with_last(Explanation one, std::size_t effect);

}  // namespace cartwright
