#pragma once

#include "host/diagnose/locate/where.hpp"

namespace cartwright {

/// Where an effect of a fit's model acts: from the push it adds [m/s^2], which is what the model takes for
/// the cart's acceleration at each row less what it does without the effect, both held to the readings.
///
/// - Along an axis of bins: the stretch of neighbouring bins that holds most of the push's power beyond twice
///   its mean over all rows in which the cart moves, and a quarter of it at least; of two ends, the stronger.
///   Empty where there is none: it acts everywhere.
/// - `frequency_hz`: from the 10th to the 90th percentile of the power of the push.
///
/// A disturbance acts from its start to its end. An error of the encoder pushes nothing: empty everywhere.
Where where_it_acts(Term effect, const Session& session, const Fit& fit, const FitOptions& options);

}  // namespace cartwright
