#include "host/diagnose/search/refits.hpp"

#include <algorithm>
#include <iterator>

namespace cartwright {
namespace {

constexpr int kRoundsOfSketch = 2;  // of physics and noise
constexpr int kIterationsOfSketch = 6;
constexpr double kToleranceOfSketch = 2.0;  // nats
constexpr double kNoiseStepOfSketch = 0.15;

/// The parameters of a fit that are not of this term.
std::vector<FreeParameter> free_beside(const Fit& fit, Term term) {
  std::vector<FreeParameter> free;
  std::copy_if(fit.free.begin(), fit.free.end(), std::back_inserter(free),
               [&](const FreeParameter& p) { return info(p.id).term != term; });
  return free;
}

}  // namespace

FitOptions of_sketch(FitOptions options) {
  options.most_rounds = kRoundsOfSketch;
  options.most_iterations = kIterationsOfSketch;
  options.tolerance = kToleranceOfSketch;
  options.covariance = false;
  options.coarsely = true;
  options.finest_noise_step = kNoiseStepOfSketch;
  return options;
}

FitOptions with_kinks(const Model& model, FitOptions options) {
  if (!model.has(Term::backlash)) return options;
  options.difference_step = kStepOverKinks;
  options.most_rounds = std::min(options.most_rounds, 2);
  options.tolerance = kToleranceOfSketch;
  return options;
}

Fit finished(const Session& data, const Fit& sketch, const FitOptions& options) {
  return fit(data, sketch.model, sketch.noise, sketch.free, with_kinks(sketch.model, options));
}

Explanation doing_without(const Session& session, const Explanation& from, std::size_t effect,
                          const FitOptions& options) {
  Explanation without = from;
  const Term term = from.effects[effect];
  without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  if (term == Term::encoder_missed_counts) without.jumps.clear();
  Model model = from.fit.model;
  model.remove(term);
  without.fit = fit(without_jumps(session, without.jumps), model, from.fit.noise, free_beside(from.fit, term),
                    with_kinks(model, options));
  return without;
}

Explanation in_place_of(const Session& session, const Explanation& from, std::size_t effect,
                        const Explanation& rival, double worth_finishing, const FitOptions& options) {
  Explanation swapped = from;
  const Term old = from.effects[effect], term = rival.effects.back();
  swapped.effects[effect] = term;
  Model model = from.fit.model;
  model.remove(old);
  if (term == Term::external_disturbance) model.disturbance_recording = rival.fit.model.disturbance_recording;
  std::vector<FreeParameter> free = free_beside(from.fit, old);
  for (const FreeParameter& p : rival.fit.free) {
    if (info(p.id).term == term) free.push_back(p);
  }
  for (const ParameterInfo& number : parameters()) {
    if (number.term == term) model.set(number.id, rival.fit.model[number.id]);
  }
  const Session data = without_jumps(session, from.jumps);
  swapped.fit = fit(data, model, from.fit.noise, free, with_kinks(model, of_sketch(options)));
  if (swapped.score() > worth_finishing) swapped.fit = finished(data, swapped.fit, options);
  return swapped;
}

Explanation with_last(Explanation one, std::size_t effect) {
  const auto at = one.effects.begin() + static_cast<std::ptrdiff_t>(effect);
  std::rotate(at, at + 1, one.effects.end());
  return one;
}

}  // namespace cartwright
