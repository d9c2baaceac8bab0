#include "host/diagnose/search/screen.hpp"

#include <algorithm>
#include <cmath>

#include "host/diagnose/fit/basis.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

/// A start may be off by this factor and still be judged by its column.
constexpr double kMostMultiple = 5;

bool has_sign(Term term) {
  switch (term) {
    case Term::constant_force:
    case Term::asymmetric_viscous_friction:
    case Term::amplifier_gain_asymmetry:
    case Term::cable_spring:
    case Term::motor_heating:
      return true;
    default:
      return false;
  }
}

/// What the best multiple of a column would gain [nats], the model's own numbers refitted beside it.
double gain_of(const Basis& basis, Eigen::VectorXd column, bool either_sign) {
  basis.project_out(column);
  const double cc = column.squaredNorm();
  if (!(cc > 0)) return 0;
  double multiple = -column.dot(basis.e) / cc;
  if (!either_sign) multiple = std::clamp(multiple, 0.0, kMostMultiple);
  return basis.gain((basis.e + multiple * column).squaredNorm());
}

}  // namespace

std::vector<Promise> screen(const Session& session, const Fit& base, const std::vector<Candidate>& list,
                            const FitOptions& options, unsigned threads) {
  const Basis basis = basis_of(base, options.outlier_m);
  const auto rows = basis.e.size();

  std::vector<Promise> promises;
  for (const Candidate& candidate : list) {
    for (const auto& start : candidate.starts) {
      Promise promise{candidate.term, with_start(base.model, start), base.free, 0};
      promise.free.insert(promise.free.end(), candidate.free.begin(), candidate.free.end());
      promises.push_back(std::move(promise));
    }
  }
  parallel_for(promises.size(), threads, [&](std::size_t i) {
    Promise& promise = promises[i];
    const std::vector<double> errors = counted_errors(session, promise.start, base.noise, options).error_m;
    Eigen::VectorXd column = Eigen::Map<const Eigen::VectorXd>(errors.data(), rows) -
                             Eigen::Map<const Eigen::VectorXd>(base.error_m.data(), rows);
    promise.log_likelihood_gain = gain_of(basis, column, has_sign(promise.term));
    if (options.outlier_m > 0) {
      // Rows that a start throws off course hide the others; where it is only too strong they are its shape.
      const double most = 2 * options.outlier_m;
      const double clipped = gain_of(basis, column.cwiseMin(most).cwiseMax(-most), has_sign(promise.term));
      promise.log_likelihood_gain = std::max(promise.log_likelihood_gain, clipped);
    }
  });
  std::stable_sort(promises.begin(), promises.end(), [](const Promise& a, const Promise& b) {
    return a.log_likelihood_gain > b.log_likelihood_gain;
  });
  return promises;
}

}  // namespace cartwright
