#include <algorithm>
#include <cmath>

#include "host/diagnose/position_spectrum.hpp"
#include "host/diagnose/scan.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kPeaksKept = 3;

/// The tops of a spectrum from `first` on, highest first.
std::vector<std::size_t> highest_tops(const std::vector<Wave>& waves, std::size_t first) {
  std::vector<std::size_t> tops;
  for (std::size_t i = first; i < waves.size(); ++i) {
    if (i > first && waves[i - 1].gain > waves[i].gain) continue;
    if (i + 1 < waves.size() && waves[i + 1].gain >= waves[i].gain) continue;
    tops.push_back(i);
  }
  std::sort(tops.begin(), tops.end(), [&](auto a, auto b) { return waves[a].gain > waves[b].gain; });
  if (tops.size() > kPeaksKept) tops.resize(kPeaksKept);
  return tops;
}

}  // namespace

std::vector<Promise> scan_periods(const Session& session, const Fit& base, const SessionFacts& facts,
                                  const FitOptions& options, unsigned threads) {
  const PositionSpectrum spectrum =
      position_spectrum(session, base, facts, options, Waves::of_push_and_reading, threads);
  std::vector<Promise> promises;
  const auto take_tops = [&](const std::vector<Wave>& waves, Term term, Parameter amplitude, Parameter period,
                             Parameter phase) {
    for (const std::size_t i : highest_tops(waves, spectrum.first_told_apart())) {
      Model start = base.model;
      start.set(amplitude, std::hypot(waves[i].sine, waves[i].cosine));
      start.set(period, 1 / spectrum.frequency_per_m(i));
      start.set(phase, std::atan2(waves[i].cosine, waves[i].sine));
      Promise promise{term, start, base.free, waves[i].gain - std::log(static_cast<double>(waves.size()))};
      for (const Parameter id : {amplitude, period, phase})
        promise.free.push_back(free_parameter(id, facts, start));
      promises.push_back(std::move(promise));
    }
  };
  if (!base.model.has(Term::cogging)) {
    take_tops(spectrum.push, Term::cogging, Parameter::cogging_amplitude, Parameter::cogging_period,
              Parameter::cogging_phase);
  }
  if (!base.model.has(Term::encoder_eccentricity)) {
    take_tops(spectrum.reading, Term::encoder_eccentricity, Parameter::eccentricity_amplitude,
              Parameter::eccentricity_period, Parameter::eccentricity_phase);
  }
  return promises;
}

}  // namespace cartwright
