#include "host/diagnose/judge/support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

constexpr double kByChance = 0.01;  // over the recordings of a session
constexpr double kSays = 0.95;      // both sides

}  // namespace

double Support::windows_moved_m() const {
  const auto square = [](double x) { return x * x; };
  return std::sqrt(std::max(square(windows_without_m) - square(windows_with_m), 0.0));
}

std::size_t Support::recordings_for() const {
  return static_cast<std::size_t>(std::count_if(
      recordings.begin(), recordings.end(), [](const RecordingSays& r) { return r.z() > normal(kSays); }));
}

bool Support::most_say_so() const {
  return recordings.size() >= 3 && 2 * recordings_for() > recordings.size();
}

std::vector<Support> support_of_effects(const Session& session, const Search& search,
                                        const std::vector<SquaredError>& windows, FitOptions options) {
  options.move_noise = false;
  options.covariance = false;
  const auto as_it_is = [&](const Session& data, const Explanation& one) {
    return fit(data, one.fit.model, search.best.fit.noise, {}, options);
  };
  const Fit with = as_it_is(without_jumps(session, search.best.jumps), search.best);
  std::vector<Support> all;
  for (const Contest& effect : search.contests) {
    const Explanation& without = effect.before;
    const Session data = without_jumps(session, without.jumps);
    Support support;
    for (const PairedDifference& d : differences_by_recording(with, as_it_is(data, without)))
      support.recordings.push_back({session.recordings[support.recordings.size()].file, d.nats, d.spread});
    const std::vector<SquaredError> windows_without = window_errors(without.fit.model, data, options.threads);
    support.windows_with_m = rms_m(windows);
    support.windows_without_m = rms_m(windows_without);
    support.windows_get_worse = worse_beyond_chance(windows, windows_without);
    all.push_back(std::move(support));
  }
  return all;
}

const RecordingSays* contradiction(const Support& support, double least_gain) {
  if (support.recordings.empty()) return nullptr;
  double all_for = 0;
  for (const RecordingSays& r : support.recordings) all_for += std::max(r.nats, 0.0);
  const auto worst =
      std::min_element(support.recordings.begin(), support.recordings.end(),
                       [](const RecordingSays& a, const RecordingSays& b) { return a.z() < b.z(); });
  const double chance = normal(1 - 2 * kByChance / static_cast<double>(support.recordings.size()));
  const double matters = std::max(least_gain, kLeastShareOfGain * all_for);
  return worst->z() < -chance && worst->nats < -matters ? &*worst : nullptr;
}

std::string unsupported(const std::vector<Contest>& effects, const std::vector<Support>& support,
                        double least_gain) {
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const std::string_view effect = info(effects[i].chosen).name;
    if (const RecordingSays* against = contradiction(support[i], least_gain))
      return fmt::format("{} is told worse than without {} (by {:.0f} nats, {:.1f} standard errors)",
                         against->file, effect, -against->nats, -against->z());
    if (support[i].windows_get_worse)
      return fmt::format("windows are predicted worse than without {}, beyond chance", effect);
  }
  return "";
}

}  // namespace cartwright
