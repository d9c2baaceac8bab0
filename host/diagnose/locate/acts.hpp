#pragma once

#include <vector>

#include "host/diagnose/fit/fit.hpp"
#include "host/diagnose/locate/axes.hpp"
#include "host/diagnose/locate/where.hpp"

namespace cartwright {

/// Where the effects of a fit's model act: from the push that each adds [m/s^2], which is what the model
/// takes for the cart's acceleration at each row less what it does without the effect, both held to the
/// readings.
class Acts {
 public:
  /// Session and fit must outlive it.
  Acts(const Session& session, const Fit& fit, const FitOptions& options);

  /// - Along an axis of bins: the stretch of neighbouring bins that holds most of the push's power beyond
  ///   twice its mean over all rows in which the cart moves, and a quarter of it at least; of two ends, the
  ///   stronger. Empty where there is none: it acts everywhere.
  /// - `frequency_hz`: from the 10th to the 90th percentile of the power of the push.
  ///
  /// A disturbance acts from its start to its end. An error of the encoder pushes nothing: empty everywhere.
  Where where(Term effect) const;

 private:
  std::vector<Observation> seen_by(const Model& model) const;

  const Session& session_;
  const Fit& fit_;
  unsigned threads_;
  ObserverGains gains_;
  std::vector<Observation> with_;
  std::vector<AxisBins> axes_;
};

}  // namespace cartwright
