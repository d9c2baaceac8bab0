#include "host/diagnose/search/explain.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/search/evolve_gap.hpp"
#include "host/diagnose/search/lost_counts.hpp"
#include "host/diagnose/search/plausible.hpp"
#include "host/diagnose/search/promises.hpp"
#include "host/diagnose/search/promises_beside_gap.hpp"
#include "host/diagnose/search/race_beside_gap.hpp"
#include "host/diagnose/search/refits.hpp"
#include "host/diagnose/search/worth_fitting.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

/// Ends a search that keeps finding what it drops again.
constexpr std::size_t kMostStages = 8;
/// What is found third, a gap among them, mostly makes up for what the numbers of the gap still lack.
constexpr std::size_t kMostEffectsWithGap = 2;
constexpr int kMostEvolutions = 3;  // of a gap, after each effect
constexpr int kIterationsOfSlowSketch = 3;
constexpr double kSketchNearEnough = 0.5;     // of the least gain
constexpr double kNearTheBest = 0.7;          // of the best gain
constexpr double kWorthFinishing = 0.3;       // of the best gain
constexpr std::size_t kRivalsAskedAgain = 2;  // of each effect, once there are further ones

class Explainer {
 public:
  Explainer(const Session& session, const Model& nominal, const SearchOptions& options)
      : session_(session), nominal_(nominal), options_(options), facts_(facts_of(session)) {
    fit_options_ = options.fit ? *options.fit : options_for(session, nominal);
    fit_options_.threads = options.threads;  // where fits run side by side, the last one gets them all
  }

  Search run() {
    Search search;
    report("refitting the nominal model", 0);
    const NoiseModel noise = search_noise(session_, nominal_, fit_options_);
    search.nominal = fit(session_, nominal_, noise, {}, fit_options_);
    set_outlier(search.nominal);
    search.nominal = fit(session_, nominal_, search.nominal.noise, {}, fit_options_);
    search.refitted.fit = fit(session_, nominal_, search.nominal.noise, free_of_nominal(), fit_options_);
    set_outlier(search.refitted.fit);
    search.refitted.fit = fit(session_, search.refitted.fit.model, search.refitted.fit.noise,
                              search.refitted.fit.free, fit_options_);
    search.best = search.refitted;
    if (options_.least_gain) least_gain_ = options_.least_gain(search.refitted.fit);
    bool went_on = false;
    for (std::size_t stage = 0; stage < kMostStages && may_have_more(search.best); ++stage) {
      report("looking for what was left out",
             std::min(0.95,
                      (0.2 + static_cast<double>(stage)) / static_cast<double>(options_.most_effects + 1)));
      const double so_far = search.best.score() - search.refitted.score();
      const double bar = least_further_gain(so_far);
      std::vector<Explanation> tried = next_effects(search, stage, bar);
      if (tried.empty() || tried.front().score() - search.best.score() < bar) break;
      if (only_went_on(search, tried.front(), bar)) {
        if (std::exchange(went_on, true)) break;  // once more, from there
        continue;
      }
      Contest contest{tried.front().effects.back(),
                      tried.front().score() - search.best.score(),
                      search.best.score(),
                      tried.front(),
                      {},
                      search.best};
      search.best = tried.front();
      contest.alternatives.assign(std::make_move_iterator(tried.begin() + 1),
                                  std::make_move_iterator(tried.end()));
      search.contests.push_back(std::move(contest));
      evolve_again(search, found_gap_last(search) ? 1 : kMostEvolutions);
      swap_stand_ins(search);
      drop_redundant(search);
    }
    if (found_gap_last(search)) evolve_again(search, kMostEvolutions);
    add_cogging_waves(search);
    refit_without_each(search);
    report("done", 1);
    return search;
  }

 private:
  void report(std::string_view what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  std::vector<FreeParameter> free_of_nominal() const {
    std::vector<FreeParameter> free = free_parameters(nominal_, facts_);
    std::erase_if(free, [this](const FreeParameter& p) {
      return std::find(options_.held.begin(), options_.held.end(), p.id) != options_.held.end();
    });
    return free;
  }

  bool may_have_more(const Explanation& found) const {
    if (!found.has(Term::backlash)) return found.effects_beyond_every_cart() < options_.most_effects;
    const auto found_beside_friction = std::count_if(
        found.effects.begin(), found.effects.end(),
        [](Term one) { return one != Term::viscous_friction && one != Term::coulomb_friction; });
    return static_cast<std::size_t>(found_beside_friction) <
           std::min(kMostEffectsWithGap, options_.most_effects);
  }

  /// What a further effect must gain.
  double least_further_gain(double so_far) const { return std::max(least_gain_, kLeastShareOfGain * so_far); }

  void set_outlier(const Fit& at) { fit_options_.outlier_m = kOutlierOverNoise * robust_size(at); }

  /// Every promising term added to the best explanation so far, fitted; best score first.
  std::vector<Explanation> next_effects(Search& search, std::size_t stage, double least_gain) {
    const Explanation& base = search.best;
    const Session data = base.jumps.empty() ? session_ : without_jumps(session_, base.jumps);
    const bool beside_gap = base.has(Term::backlash);
    FitOptions sketch = of_sketch(fit_options_);
    if (base.has_two_masses()) sketch.most_rounds = 1, sketch.most_iterations = kIterationsOfSlowSketch;
    if (beside_gap) sketch = with_kinks(base.fit.model, sketch);
    const std::vector<Promise> promises =
        beside_gap ? promises_beside_gap(data, base.fit, facts_, sketch, options_.threads)
                   : all_promises(data, base.fit, facts_, fit_options_, options_.threads);
    if (stage == 0) search.promises = promises;
    // Lost counts cost no search: what cannot come near them need not be fitted.
    const std::optional<Explanation> lost = lost_counts_on(base);
    const double to_reach = lost ? std::max(least_gain, lost->score() - base.score()) : least_gain;
    std::vector<Promise> chosen = worth_fitting(promises, to_reach, base);
    const auto gap = std::find_if(chosen.begin(), chosen.end(), is_gap);
    if (gap != chosen.end()) {
      const std::optional<Promise> better =
          scan_gaps(data, base.fit, *gap, facts_, with_kinks(gap->start, fit_options_), options_.threads);
      std::erase_if(chosen, is_gap);
      if (better) chosen.insert(chosen.begin(), *better);
    }
    std::vector<Fit> fits(chosen.size());
    if (beside_gap) {
      fits = race_beside_gap(data, base.fit, chosen, to_reach, sketch, options_.threads);
    } else {
      parallel_for(chosen.size(), options_.threads, [&](std::size_t i) {
        fits[i] = fit(data, chosen[i].start, chosen[i].noise.value_or(base.fit.noise), chosen[i].free,
                      with_kinks(chosen[i].start, sketch));
      });
    }
    std::vector<Explanation> tried(fits.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
      tried[i].effects = base.effects;
      tried[i].effects.push_back(chosen[i].term);
      tried[i].jumps = base.jumps;
      tried[i].fit = std::move(fits[i]);
    }
    if (lost) tried.push_back(*lost);
    tried = best_per_term(std::move(tried));
    finish_best(tried, base.score(), least_gain);
    std::erase_if(tried, [this](const Explanation& one) {
      return !plausible(one.fit, one.effects.back(), session_, facts_);
    });
    put_simplest_first(tried, base.score());
    return tried;
  }

  /// A law with more numbers may lead only because it bends towards what is still missing. The simplest that
  /// comes near goes first; what it lacks is looked for next, and if that makes it redundant it is dropped
  /// again.
  static void put_simplest_first(std::vector<Explanation>& tried, double base_score) {
    if (tried.empty()) return;
    const double bar = base_score + kNearTheBest * (tried.front().score() - base_score);
    auto simplest = tried.begin();
    for (auto one = tried.begin(); one != tried.end() && one->score() >= bar; ++one) {
      if (one->fit.free.size() < simplest->fit.free.size()) simplest = one;
    }
    std::rotate(tried.begin(), simplest, simplest + 1);
  }

  /// Fits the leading explanations to the end; the rest are only there to be told from. None where the best
  /// is far from what it has to gain.
  void finish_best(std::vector<Explanation>& tried, double base_score, double least_gain) const {
    if (tried.empty() || tried.front().score() - base_score < kSketchNearEnough * least_gain) return;
    const double bar = base_score + kWorthFinishing * (tried.front().score() - base_score);
    parallel_for(tried.size(), options_.threads, [&](std::size_t i) {
      if (tried[i].score() < bar) return;
      tried[i].fit = finished(without_jumps(session_, tried[i].jumps), tried[i].fit, fit_options_);
    });
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Explanation& a, const Explanation& b) { return a.score() > b.score(); });
  }

  std::optional<Explanation> lost_counts_on(const Explanation& base) const {
    if (base.has(Term::encoder_missed_counts)) return std::nullopt;
    const std::vector<ReadingJump> jumps = scan_jumps(session_, base.fit, fit_options_);
    if (!like_lost_counts(session_, jumps)) return std::nullopt;
    Explanation lost = base;
    lost.effects.push_back(Term::encoder_missed_counts);
    lost.jumps = jumps;
    const Session data = without_jumps(session_, jumps);
    lost.fit = fit(data, base.fit.model, base.fit.noise, base.fit.free, fit_options_);
    lost.fit.model.add(Term::encoder_missed_counts);
    return lost;
  }

  static std::vector<Explanation> best_per_term(std::vector<Explanation> tried) {
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Explanation& a, const Explanation& b) { return a.score() > b.score(); });
    std::vector<Explanation> kept;
    for (Explanation& one : tried) {
      const bool seen = std::any_of(kept.begin(), kept.end(), [&](const Explanation& other) {
        return other.effects.back() == one.effects.back();
      });
      if (!seen) kept.push_back(std::move(one));
    }
    return kept;
  }

  /// A fit among kinks ends where it cannot go on, and a further effect may gain only because its fit went on
  /// from there. Then what it found without that effect is taken, and the effect is not.
  bool only_went_on(Search& search, const Explanation& further, double bar) const {
    if (!search.best.has(Term::backlash) || further.effects.back() == Term::encoder_missed_counts)
      return false;
    Explanation without = doing_without(session_, further, further.effects.size() - 1, fit_options_);
    if (further.score() - without.score() >= bar) return false;
    if (without.score() > search.best.score()) search.best = std::move(without);
    return true;
  }

  static bool found_gap_last(const Search& search) {
    return !search.best.effects.empty() && search.best.effects.back() == Term::backlash;
  }

  /// What is added beside a gap moves the gap's numbers, which evolve again; what that gains is the gap's.
  void evolve_again(Search& search, int most_times) {
    const auto gap = std::find_if(search.contests.begin(), search.contests.end(),
                                  [](const Contest& one) { return one.chosen == Term::backlash; });
    Explanation& best = search.best;
    const double before = best.score();
    if (gap == search.contests.end() || before == evolved_in_vain_) return;
    const double bar = least_further_gain(before - search.refitted.score());
    best.fit = evolved_gap(without_jumps(session_, best.jumps), best.fit, bar, most_times,
                           with_kinks(best.fit.model, fit_options_), options_.threads);
    gap->gain += best.score() - before;
    if (best.score() == before) evolved_in_vain_ = before;
  }

  /// An effect found early may have stood in for a rival that does better beside what was found later. What
  /// every cart has stands in for nothing.
  void swap_stand_ins(Search& search) const {
    if (search.best.has_two_masses()) return;
    for (std::size_t i = 0; i + 1 < search.contests.size(); ++i) {
      Contest& contest = search.contests[i];
      if (every_cart_has(contest.chosen) || contest.chosen == Term::encoder_missed_counts) continue;
      std::vector<Explanation> rivals;
      for (const Explanation& rival : contest.alternatives) {
        const Term term = rival.effects.back();
        if (rivals.size() == kRivalsAskedAgain) break;
        if (!search.best.has(term) && !two_masses(term) && term != Term::encoder_missed_counts)
          rivals.push_back(rival);
      }
      const double worth_finishing = search.best.score() - (1 - kNearTheBest) * contest.gain;
      parallel_for(rivals.size(), options_.threads, [&](std::size_t n) {
        rivals[n] = in_place_of(session_, search.best, i, rivals[n], worth_finishing, fit_options_);
      });
      for (const Explanation& swapped : rivals) {
        const double better = swapped.score() - search.best.score();
        if (better < least_gain_ || !plausible(swapped.fit, swapped.effects[i], session_, facts_)) continue;
        contest.chosen = swapped.effects[i];
        contest.gain += better;
        contest.without = swapped.score() - contest.gain;
        contest.winner = with_last(swapped, i);
        contest.alternatives = {with_last(search.best, i)};
        search.best = swapped;
      }
    }
  }

  /// An effect found early may only have stood in for one found later. Beside a gap, whose form is slightly
  /// off until all else is known, it must gain what it had to gain to be found.
  void drop_redundant(Search& search) const {
    const double so_far = search.best.score() - search.refitted.score();
    const double bar = search.best.has(Term::backlash) ? least_further_gain(so_far) : least_gain_;
    for (std::size_t i = 0; i + 1 < search.best.effects.size(); ++i) {
      const Term term = search.best.effects[i];
      if (term == Term::encoder_missed_counts) continue;
      Explanation without = doing_without(session_, search.best, i, fit_options_);
      if (search.best.score() - without.score() >= bar) {
        search.contests[i].before = std::move(without);
        continue;
      }
      search.best = std::move(without);
      search.contests.erase(search.contests.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }

  /// What is compared with each effect is all the others, with all their numbers, and those may have changed
  /// since it was found.
  void refit_without_each(Search& search) const {
    for (std::size_t i = 0; i < search.contests.size(); ++i) {
      Contest& contest = search.contests[i];
      std::vector<Term> others = search.best.effects;
      std::erase(others, contest.chosen);
      const std::vector<Term>& before = contest.before.effects;
      const std::vector<FreeParameter>& free = search.best.fit.free;
      const auto others_numbers = std::count_if(free.begin(), free.end(), [&](const FreeParameter& p) {
        return info(p.id).term != contest.chosen;
      });
      if (!std::is_permutation(others.begin(), others.end(), before.begin(), before.end()) ||
          others_numbers != std::ssize(contest.before.fit.free))
        contest.before = doing_without(session_, search.best, i, fit_options_);
    }
  }

  /// Cogging may repeat with several periods. Each further one must gain what an effect must; it is no effect
  /// of its own.
  void add_cogging_waves(Search& search) const {
    const auto cogging = std::find_if(search.contests.begin(), search.contests.end(),
                                      [](const Contest& one) { return one.chosen == Term::cogging; });
    if (cogging == search.contests.end()) return;
    const Session data = without_jumps(session_, search.best.jumps);
    while (const auto wave =
               scan_further_wave(data, search.best.fit, facts_, fit_options_, options_.threads)) {
      if (wave->log_likelihood_gain < least_gain_ / kMostGainOverPromise) return;
      Explanation further = search.best;
      further.fit =
          fit(data, wave->start, search.best.fit.noise, wave->free, with_kinks(wave->start, fit_options_));
      const double gain = further.score() - search.best.score();
      if (gain < least_gain_ || !plausible(further.fit, Term::cogging, session_, facts_)) return;
      cogging->gain += gain;
      search.best = std::move(further);
    }
  }

  const Session& session_;
  const Model& nominal_;
  const SearchOptions& options_;
  SessionFacts facts_;
  FitOptions fit_options_;
  double least_gain_ = kLeastGain;  ///< of an effect
  /// The score from which a gap's evolution, the same each time, led nowhere.
  std::optional<double> evolved_in_vain_;
};

}  // namespace

Search explain(const Session& session, const Model& nominal, const SearchOptions& options) {
  return Explainer(session, nominal, options).run();
}

}  // namespace cartwright
