#include "host/diagnose/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "host/diagnose/judge/adequacy.hpp"
#include "host/diagnose/judge/estimate.hpp"
#include "host/diagnose/judge/further_push.hpp"
#include "host/diagnose/judge/held_out.hpp"
#include "host/diagnose/judge/held_out_push.hpp"
#include "host/diagnose/judge/left_over.hpp"
#include "host/diagnose/judge/name_from_drive.hpp"
#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/diagnose/judge/predicts_no_better.hpp"
#include "host/diagnose/judge/remarks.hpp"
#include "host/diagnose/judge/statement.hpp"
#include "host/diagnose/judge/support.hpp"
#include "host/diagnose/judge/surrogate.hpp"
#include "host/diagnose/judge/told_apart.hpp"
#include "host/diagnose/judge/whole_recordings.hpp"
#include "host/diagnose/locate/acts.hpp"
#include "host/diagnose/locate/where.hpp"
#include "host/diagnose/search/lost_counts.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// A number that a nominal model holds may be this far off before that is worth saying (contract, `verdict`).
constexpr double kLeastParameterChange = 0.08;
constexpr double kSureOfChange = 0.997;  // of three numbers or so one is off by chance in 100 sessions
constexpr double kShowsMismatch = 1.5;   // window error over noise floor
/// So much of it left is worth telling beside a name.
constexpr double kWorthTelling = 0.05;

double relative_change(double from, double to) {
  return from != 0 ? std::abs(to / from - 1) : (to != 0 ? 1.0 : 0.0);
}

class Diagnostician {
 public:
  Diagnostician(const Session& session, const Model& nominal, const DiagnoseOptions& options)
      : session_(session), nominal_(nominal), options_(options) {}

  Diagnosis run() {
    std::vector<std::size_t> held = choose_held_out(session_);
    Session used = without(session_, held);
    SearchOptions search;
    search.threads = options_.threads;
    search.held = options_.held;
    search.fit = fit_options_;
    search.progress = [this](std::string_view what, double share) { report(what, 0.8 * share); };
    search_for_physics(used, search);
    if (!held.empty() && is_worth_using(held, used)) {
      result_.remarks.push_back(
          fmt::format("{} holds something of its own, so it was used and nothing held out.",
                      session_.recordings[held.front()].file));
      held.clear();
      used = session_;
      search_for_physics(used, search);
    }
    for (const std::size_t n : held) result_.held_out_recordings.push_back(session_.recordings[n].file);
    const Search& found = result_.search;

    const Session repaired = without_jumps(used, found.best.jumps);
    result_.model = found.best.fit.model;
    result_.refitted = found.refitted.fit.model;

    report("replaying windows", 0.88);
    measure(used, held);
    support_ = support_of_effects(used, found, windows_used_.with_effects, with_threads());
    judge(repaired);
    refit_where_much_is_left(used, held);
    name_effects(repaired);
    name_parameters();
    propose(used);
    if (drive_only_balances_ && result_.verdict == Verdict::unexplained) read_the_drive(used, held);
    const std::vector<std::string> said = remarks(session_, nominal_, options_.held, result_);
    result_.remarks.insert(result_.remarks.end(), said.begin(), said.end());
    report("done", 1);
    return std::move(result_);
  }

 private:
  void search_for_physics(const Session& used, SearchOptions search) {
    // Where a cart that is exactly the model shows more than chance, an effect must gain as much more.
    search.least_gain = [&](const Fit& refitted) {
      result_.before = located(used, refitted);
      return least_gain_ = kLeastGain * result_.before.beyond_chance;
    };
    result_.search = explain(used, nominal_, search);
    report("locating what is left", 0.82);
    const Explanation& best = result_.search.best;
    const std::vector<Contest>& contests = result_.search.contests;
    result_.after = contests.empty() ? result_.before : located(without_jumps(used, best.jumps), best.fit);
  }

  void report(std::string_view what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  Location located(const Session& session, const Fit& fit) const {
    const FitOptions options = with_threads();
    return locate(session, fit, alike(session, fit, options), options);
  }

  FitOptions with_threads() const {
    FitOptions options = fit_options_;
    options.threads = options_.threads;
    return options;
  }

  /// A push that happened only in the recording kept out would never be found without it. One that does not
  /// stand out is still no reason to refuse what explains all else: the law may have another form than its
  /// term's, so all recordings are asked.
  bool is_worth_using(const std::vector<std::size_t>& held, const Session& used) const {
    const Explanation& best = result_.search.best;
    const HeldOutPush push = push_in(only(session_, held), used, best, fit_options_);
    if (!push.shows || push.stands_out || best.has(Term::backlash)) return push.stands_out;
    return likelihood_left(result_.after, result_.search) <= kMostLeftOfLikelihood;
  }

  void judge(const Session& repaired) {
    const Search& found = result_.search;
    const double of_likelihood = likelihood_left(result_.after, found);
    const double of_windows = of_likelihood > 0 ? window_share_left() : 0;
    std::string why_refused = predicts_no_better(result_, windows_used_, windows_unseen_);
    drive_only_balances_ = result_.used.with_effects > result_.uniform_motion_m;
    if (why_refused.empty()) why_refused = further_push(repaired, found, fit_options_);
    if (why_refused.empty()) why_refused = unsupported(found.contests, support_, least_gain_);
    const double share_left = why_refused.empty() ? std::max(of_windows, of_likelihood) : 1;
    if (why_refused.empty() && too_much_left(of_windows, of_likelihood, support_))
      why_refused =
          fmt::format("{:.0f} % of what the model misses is still there, far above chance", 100 * share_left);
    const bool refused = !why_refused.empty();
    if (refused || of_likelihood > kWorthTelling)
      result_.unexplained = left_over(result_, share_left, why_refused);
    if (refused) {
      result_.verdict = Verdict::unexplained;
      result_.model = found.refitted.fit.model;
      for (Errors* e :
           {&result_.used, &result_.held_out, &result_.used_closed_loop, &result_.held_out_closed_loop}) {
        e->with_effects = e->refitted;
      }
    } else if (!found.contests.empty()) {
      result_.verdict = Verdict::missing_physics;
    } else {
      result_.verdict = values_changed() ? Verdict::parameters_only : Verdict::no_mismatch;
    }
  }

  /// Errors of one step take what has no name for noise; where that is much, whole recordings know better.
  void refit_where_much_is_left(const Session& used, const std::vector<std::size_t>& held) {
    const bool much = result_.unexplained && result_.unexplained->share_left > kMostLeftOfWindows;
    if (!much || result_.verdict != Verdict::missing_physics) return;
    report("refitting to whole recordings", 0.89);
    const Session repaired = without_jumps(used, result_.search.best.jumps);
    const auto better = fitted_to_whole_recordings(result_.model, repaired, options_.held, options_.threads);
    if (!better) return;
    result_.model = *better;
    measure(used, held);
    result_.remarks.push_back(
        "Much stays unexplained, so gain, frictions and steady pushes are those that predict whole "
        "recordings best.");
  }

  /// What no prediction tells the drive itself may: it balances what pushes a cart that a servo moves evenly.
  void read_the_drive(const Session& used, const std::vector<std::size_t>& held) {
    report("reading the drive", 0.9);
    const std::optional<DriveBalance> drive = drive_balance(used, options_.threads);
    if (!drive || !names_cogging(*drive)) return;
    name_from_drive(*drive, nominal_, result_);
    result_.drive = drive;
    result_.used.with_effects = window_rmse_m(result_.model, used, options_.threads);
    if (!held.empty())
      result_.held_out.with_effects = window_rmse_m(result_.model, only(session_, held), options_.threads);
    const Fit as_it_is = fit(used, result_.model, result_.search.best.fit.noise, {}, fit_options_);
    result_.effects.front().where = Acts(used, as_it_is, with_threads()).where(Term::cogging);
    result_.after = located(used, as_it_is);
    result_.unexplained = left_over(result_, drive->share_left(), "");
    result_.unexplained->closest.reset();
    result_.unexplained->periods_m.clear();
    for (std::size_t i = drive->held; i < drive->lines.size(); ++i)
      result_.unexplained->periods_m.push_back(drive->lines[i].period_m.value);
    result_.remarks.push_back(statement_of_drive(*drive));
  }

  double window_share_left() const {
    if (result_.search.contests.empty()) return 1;
    const double of_used = excess_left(result_.used, result_.noise_floor_m);
    // What was kept out counts where it shows the mismatch at all.
    const bool shows = held_floor_m_ > 0 && result_.held_out.refitted > kShowsMismatch * held_floor_m_;
    return shows ? std::max(of_used, excess_left(result_.held_out, held_floor_m_)) : of_used;
  }

  bool values_changed() const {
    const Fit& fit = result_.search.refitted.fit;
    return std::any_of(fit.free.begin(), fit.free.end(), [&](const FreeParameter& p) {
      const double change = std::abs(fit.model[p.id] - nominal_[p.id]);
      return relative_change(nominal_[p.id], fit.model[p.id]) > kLeastParameterChange &&
             change > normal(kSureOfChange) * fit.standard_error(p.id);
    });
  }

  void measure(const Session& used, const std::vector<std::size_t>& held) {
    const Search& found = result_.search;
    const Session repaired = without_jumps(used, found.best.jumps);
    const NoiseSize noise = noise_size(found.best.fit, session_.rig, fit_options_.damping_per_s);
    // The floor: the same windows on a cart that is exactly the model found, with the noise found.
    const auto floor_m = [&](const Session& session) {
      return window_rmse_m(result_.model, surrogate(session, result_.model, noise, 1), options_.threads);
    };
    const bool named = !found.contests.empty();
    const auto errors = [&](auto errors_of, const Session& raw, const Session& mended) {
      const std::vector<SquaredError> refitted = errors_of(found.refitted.fit.model, raw, options_.threads);
      const WindowErrors kept{errors_of(nominal_, raw, options_.threads),
                              named ? errors_of(result_.model, mended, options_.threads) : refitted};
      return std::pair{Errors{rms_m(kept.nominal), rms_m(refitted), rms_m(kept.with_effects)}, kept};
    };
    std::tie(result_.used, windows_used_) = errors(window_errors, used, repaired);
    result_.uniform_motion_m = window_rmse_m(Model(0.0), repaired, options_.threads);
    result_.used_closed_loop = errors(closed_loop_errors, used, repaired).first;
    if (!held.empty()) {
      const Session out = only(session_, held), mended = put_right(out, found.best, fit_options_);
      held_floor_m_ = floor_m(out);
      std::tie(result_.held_out, windows_unseen_) = errors(window_errors, out, mended);
      result_.held_out_closed_loop = errors(closed_loop_errors, out, mended).first;
    }
    double floor = floor_m(used);
    const double systematic =
        result_.after.repeat_z > 4 ? std::clamp(result_.after.repeat_correlation, 0.0, 1.0) : 0;
    if (systematic > 0) {
      // What repeats have in common is no noise.
      floor = std::sqrt(floor * floor * (1 - systematic) + noise.reading_m * noise.reading_m * systematic);
    }
    result_.noise_floor_m = std::min(floor, result_.used.with_effects);
  }

  void name_effects(const Session& repaired) {
    if (result_.verdict != Verdict::missing_physics) return;
    const Search& found = result_.search;
    double gains = 0;
    for (const Contest& contest : found.contests) gains += contest.gain;
    const double removed = 1 - excess_left(result_.used, result_.noise_floor_m);
    const Acts acts(repaired, found.best.fit, with_threads());
    for (std::size_t i = 0; i < found.contests.size(); ++i) {
      const Contest& contest = found.contests[i];
      Effect effect{contest.chosen, 0, {}, {}, {}, {}, 0, contest.gain, {}, "", support_[i]};
      effect.where = acts.where(contest.chosen);
      if (contest.chosen == Term::encoder_missed_counts) {
        effect.parameters = lost_counts(repaired, found.best.jumps, result_.model);
      } else {
        for (const FreeParameter& p : found.best.fit.free) {
          if (info(p.id).term != contest.chosen) continue;
          effect.parameters.emplace_back(p.id, estimate_of(result_.model, found.best.fit, p.id));
          if (found.best.fit.at_bound(p.id)) effect.at_bound.push_back(p.id);
        }
      }
      effect.share_of_excess_error_removed = removed * contest.gain / gains;
      compare(contest, gains, effect);
      effect.statement = statement(contest.chosen, result_.model);
      result_.effects.push_back(std::move(effect));
    }
    std::stable_sort(result_.effects.begin(), result_.effects.end(),
                     [](const Effect& a, const Effect& b) { return a.gain > b.gain; });
    std::stable_sort(result_.runner_up.begin(), result_.runner_up.end(),
                     [](const RunnerUp& a, const RunnerUp& b) { return a.score_behind < b.score_behind; });
  }

  /// The chosen against the others that were fitted in its place.
  void compare(const Contest& contest, double gains, Effect& effect) {
    Evidence& evidence = effect.evidence;
    evidence.gain_nats = contest.gain;
    evidence.share_of_gain = contest.gain / gains;
    evidence.share_left = result_.unexplained ? result_.unexplained->share_left : 0;
    evidence.at_bound = static_cast<int>(effect.at_bound.size());
    const double unexplained = result_.unexplained ? nats_left(result_.after) : 0;
    const std::size_t before = result_.runner_up.size();
    for (const Explanation& other : contest.alternatives) {
      if (result_.search.best.has(other.effects.back())) continue;  // named as well, beside it
      // The score of the explanation as it stood when this effect was chosen.
      const double behind = contest.winner.score() - other.score();
      const double weight = weight_of_rival(behind);
      evidence.margin_nats = std::min(evidence.margin_nats, behind);
      evidence.rivals += weight;
      if (!told_apart(contest, other, unexplained, least_gain_))
        effect.equivalent.push_back(other.effects.back());
      result_.runner_up.push_back({other.effects.back(), contest.chosen, weight, behind});
    }
    evidence.equivalent = static_cast<int>(effect.equivalent.size());
    effect.confidence = confidence(evidence);
    for (std::size_t i = before; i < result_.runner_up.size(); ++i)
      result_.runner_up[i].confidence *= effect.confidence;  // the odds are those of the weights
  }

  /// What would settle it, where the data does not: two names that it cannot tell apart, or an effect that is
  /// weak.
  void propose(const Session& used) {
    if (result_.verdict != Verdict::missing_physics) return;
    const Explanation* rival = nullptr;
    const Explanation* chosen = &result_.search.best;
    for (const Contest& contest : result_.search.contests) {
      const auto effect = std::find_if(result_.effects.begin(), result_.effects.end(),
                                       [&](const Effect& e) { return e.term == contest.chosen; });
      for (const Explanation& other : contest.alternatives) {
        if (rival || effect->equivalent.empty() || other.effects.back() != effect->equivalent.front())
          continue;
        rival = &other;
        chosen = &contest.winner;
      }
      if (!rival && contest.gain < 2 * kLeastGain && result_.search.contests.size() == 1)
        rival = &result_.search.refitted;
    }
    if (!rival) return;
    report("looking for an experiment that decides", 0.95);
    result_.next_experiment =
        next_experiment(session_.rig, *chosen, *rival, facts_of(used), fit_options_, options_.threads);
    if (!result_.next_experiment && rival != &result_.search.refitted) {
      result_.remarks.push_back(fmt::format(
          "No experiment about position zero, within this rig's travel and voltage, is likely to tell {} "
          "from {}.",
          info(chosen->effects.back()).name, info(rival->effects.back()).name));
    }
  }

  void name_parameters() {
    const Fit& refit = result_.search.refitted.fit;
    const Fit& fit = result_.verdict == Verdict::missing_physics ? result_.search.best.fit : refit;
    for (const FreeParameter& p : refit.free) {
      result_.parameters.push_back(
          {p.id, nominal_[p.id], estimate_of(result_.model, fit, p.id), refit.model[p.id]});
    }
  }

  const Session& session_;
  const Model& nominal_;
  const DiagnoseOptions& options_;
  FitOptions fit_options_ = options_for(session_, nominal_);
  Diagnosis result_;
  WindowErrors windows_used_, windows_unseen_;
  std::vector<Support> support_;  ///< of each contest
  double held_floor_m_ = 0;
  bool drive_only_balances_ = false;
  double least_gain_ = kLeastGain;  ///< that an effect had to have
};

}  // namespace

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::no_mismatch:
      return "no_mismatch";
    case Verdict::parameters_only:
      return "parameters_only";
    case Verdict::missing_physics:
      return "missing_physics";
    case Verdict::unexplained:
      return "unexplained";
  }
  return "";
}

Diagnosis diagnose(const Session& session, const Model& nominal, const DiagnoseOptions& options) {
  return Diagnostician(session, nominal, options).run();
}

}  // namespace cartwright
