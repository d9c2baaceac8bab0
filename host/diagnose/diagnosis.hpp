#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/diagnose/drive/drive_balance.hpp"
#include "host/diagnose/judge/confidence.hpp"
#include "host/diagnose/judge/next_experiment.hpp"
#include "host/diagnose/judge/support.hpp"
#include "host/diagnose/locate/locate.hpp"
#include "host/diagnose/locate/where.hpp"
#include "host/diagnose/search/explain.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright {

enum class Verdict { no_mismatch, parameters_only, missing_physics, unexplained };
std::string_view name(Verdict verdict);

struct Effect {
  Term term;
  double confidence = 0;
  Evidence evidence;             ///< that the confidence rests on
  std::vector<Term> equivalent;  ///< terms this data cannot tell from it
  std::vector<std::pair<Parameter, Estimate>> parameters;
  std::vector<Parameter> at_bound;
  double share_of_excess_error_removed = 0;
  double gain = 0;  ///< nats, net of its numbers
  Where where;
  std::string statement;
  Support support;
};

struct RunnerUp {
  Term term;
  Term instead_of;  ///< the effect in whose place it was fitted
  double confidence = 0;
  double score_behind = 0;  ///< nats behind the chosen
};

struct NominalParameter {
  Parameter id;
  double nominal = 0;
  Estimate refitted;
  double with_nominal_terms_only = 0;
};

/// Root-mean-square errors of prediction [m].
struct Errors {
  double nominal = 0, refitted = 0, with_effects = 0;
};

struct Unexplained {
  double share_left = 0;  ///< of what was missing, after the best candidate
  Where where;
  std::string axis;               ///< the axis that carries most of it
  AxisMap curve;                  ///< the missing push along that axis, with its band
  std::vector<double> periods_m;  ///< of pushes that repeat over the way, strongest first
  std::optional<Term> closest;
  std::string why_refused;
};

struct Diagnosis {
  Verdict verdict = Verdict::no_mismatch;
  std::vector<Effect> effects;  ///< strongest first
  std::vector<RunnerUp> runner_up;
  std::vector<NominalParameter> parameters;
  Errors used, held_out;                          ///< of 0.5 s windows
  Errors used_closed_loop, held_out_closed_loop;  ///< NaN where no recording comes with a controller
  double noise_floor_m = 0;
  double uniform_motion_m = 0;  ///< window error of a cart without forces, which keeps its speed
  std::vector<std::string> held_out_recordings;
  std::optional<Unexplained> unexplained;
  std::optional<NextExperiment> next_experiment;
  std::optional<DriveBalance> drive;  ///< what the effect was read from, where a servo holds the speed
  Model model;                        ///< nominal terms refitted, with the effects
  Model refitted;                     ///< nominal terms refitted alone
  Location before, after;             ///< of the refitted nominal model; of the final one
  std::vector<std::string> remarks;   ///< what the data cannot support, in words
  Search search;
};

struct DiagnoseOptions {
  unsigned threads = 2;
  std::vector<Parameter> held;  ///< numbers of the nominal model that are kept as given
  std::function<void(std::string_view what, double share_done)> progress;
};

/// Compares a nominal model with a session: where they differ, what physics was left out, the model with it,
/// and how much better that predicts recordings kept out of everything.
Diagnosis diagnose(const Session& session, const Model& nominal, const DiagnoseOptions& options = {});

}  // namespace cartwright
