#include "host/diagnose/judge/further_push.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/search/promises.hpp"
#include "host/diagnose/search/scan.hpp"

namespace cartwright {
namespace {

constexpr double kAsMuch = 0.5;  // of the gain of the named push

}  // namespace

std::string further_push(const Session& session, const Search& search, FitOptions options) {
  const auto named = std::find_if(search.contests.begin(), search.contests.end(), [](const Contest& contest) {
    return contest.chosen == Term::external_disturbance;
  });
  if (named == search.contests.end()) return "";
  const Fit& fit = search.best.fit;
  options.outlier_m = kOutlierOverNoise * robust_size(fit);
  const std::vector<Promise> left = scan_pushes(session, fit, facts_of(session), options);
  if (left.empty() || left.front().log_likelihood_gain < kAsMuch * named->gain) return "";
  const Model& next = left.front().start;
  return fmt::format("strong pushes are left, the next in {} at t = {:.2f} s", next.disturbance_recording,
                     next[Parameter::disturbance_start]);
}

}  // namespace cartwright
