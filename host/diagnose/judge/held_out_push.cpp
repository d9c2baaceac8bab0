#include "host/diagnose/judge/held_out_push.hpp"

#include "host/diagnose/search/scan.hpp"

namespace cartwright {
namespace {

/// The greatest of ten that are alike is seldom more than so many times the greatest of nine.
constexpr double kStandsOut = 2;

/// What the model as it stands makes of other recordings.
Fit as_it_is(const Session& session, const Explanation& best, FitOptions options) {
  options.move_noise = false;
  return fit(session, best.fit.model, best.fit.noise, {}, options);
}

double most_promised(const Session& session, const Fit& fit, const FitOptions& options) {
  const std::vector<Promise> promises = scan_pushes(session, fit, facts_of(session), options);
  return promises.empty() ? 0 : promises.front().log_likelihood_gain;
}

}  // namespace

Session put_right(const Session& out, const Explanation& best, const FitOptions& options) {
  if (!best.has(Term::encoder_missed_counts)) return out;
  return without_jumps(out, scan_jumps(out, as_it_is(out, best, options), options));
}

HeldOutPush push_in(const Session& out, const Session& used, const Explanation& best,
                    const FitOptions& options) {
  if (best.has(Term::external_disturbance)) return {};
  const Session mended = put_right(out, best, options);
  const double here = most_promised(mended, as_it_is(mended, best, options), options);
  if (here <= 2 * kLeastGain) return {};
  return {true, here > kStandsOut * most_promised(without_jumps(used, best.jumps), best.fit, options)};
}

}  // namespace cartwright
