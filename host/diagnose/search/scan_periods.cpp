#include <algorithm>
#include <cmath>

#include "host/diagnose/locate/position_spectrum.hpp"
#include "host/diagnose/search/plausible.hpp"
#include "host/diagnose/search/scan.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kPeaksKept = 3;

/// The tops of a spectrum from `first` on, highest first.
std::vector<std::size_t> tops_of(const std::vector<Wave>& waves, std::size_t first) {
  std::vector<std::size_t> tops;
  for (std::size_t i = first; i < waves.size(); ++i) {
    if (i > first && waves[i - 1].gain > waves[i].gain) continue;
    if (i + 1 < waves.size() && waves[i + 1].gain >= waves[i].gain) continue;
    tops.push_back(i);
  }
  std::sort(tops.begin(), tops.end(), [&](auto a, auto b) { return waves[a].gain > waves[b].gain; });
  return tops;
}

/// The wave that a top of a spectrum promises, as a start for a fit.
Promise promise_of(const PositionSpectrum& spectrum, const std::vector<Wave>& waves, std::size_t top,
                   Term term, const PeriodicTerm& as, const Fit& base, const SessionFacts& facts) {
  Model start = base.model;
  start.set(as.amplitude, std::hypot(waves[top].sine, waves[top].cosine));
  start.set(as.period, 1 / spectrum.frequency_per_m(top));
  start.set(as.phase, std::atan2(waves[top].cosine, waves[top].sine));
  Promise promise{term, start, base.free, waves[top].gain - std::log(static_cast<double>(waves.size()))};
  for (const Parameter id : {as.amplitude, as.period, as.phase})
    promise.free.push_back(free_parameter(id, facts, start));
  return promise;
}

}  // namespace

std::vector<Promise> scan_periods(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads) {
  const PositionSpectrum spectrum =
      position_spectrum(session, base, facts, options, Waves::of_push_and_reading, threads);
  std::vector<Promise> promises;
  const auto take_tops = [&](const std::vector<Wave>& waves, Term term, const PeriodicTerm& as) {
    std::size_t kept = 0;
    for (const std::size_t top : tops_of(waves, spectrum.first_told_apart())) {
      Promise promise = promise_of(spectrum, waves, top, term, as, base, facts);
      // So large an error would no longer be seen as a wave over the way that is read.
      if (term == Term::encoder_eccentricity && eccentricity_of(promise.start) > kMostEccentricity) continue;
      promises.push_back(std::move(promise));
      if (++kept == kPeaksKept) break;
    }
  };
  if (!base.model.has(Term::cogging)) take_tops(spectrum.push, Term::cogging, kCoggingWaves.front());
  if (!base.model.has(Term::encoder_eccentricity)) {
    take_tops(
        spectrum.reading, Term::encoder_eccentricity,
        {Parameter::eccentricity_amplitude, Parameter::eccentricity_period, Parameter::eccentricity_phase});
  }
  return promises;
}

std::optional<Promise> scan_further_wave(const Session& session, const Fit& base, const SessionFacts& facts,
                                         const FitOptions& options, unsigned threads) {
  const auto next = std::find_if(kCoggingWaves.begin(), kCoggingWaves.end(),
                                 [&](const PeriodicTerm& wave) { return base.model[wave.amplitude] == 0; });
  if (next == kCoggingWaves.end()) return std::nullopt;
  const PositionSpectrum spectrum = position_spectrum(session, base, facts, options, Waves::of_push, threads);
  // Nearer to a wave that is there already than this, a line says that its height changes along the way.
  const double least_distance = spectrum.frequency_per_m(spectrum.first_told_apart());
  for (const std::size_t top : tops_of(spectrum.push, spectrum.first_told_apart())) {
    const bool apart = std::all_of(kCoggingWaves.begin(), next, [&](const PeriodicTerm& wave) {
      return std::abs(spectrum.frequency_per_m(top) - 1 / base.model[wave.period]) >= least_distance;
    });
    if (apart) return promise_of(spectrum, spectrum.push, top, Term::cogging, *next, base, facts);
  }
  return std::nullopt;
}

}  // namespace cartwright
