#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/diagnose/diagnosis.hpp"
#include "tests/blind/cases.hpp"

namespace cartwright::blind {

/// One name given, and whether it was right.
struct NamedEffect {
  std::string name;
  double confidence = 0;
  bool right = false;
  Evidence evidence;
};

/// How one parameter came out.
struct ParameterOutcome {
  std::string name;
  double relative_error = 0;
  bool covered = false;  ///< the truth lies in the interval
};

struct Outcome {
  Case asked;
  std::vector<std::string> expected;
  Verdict verdict = Verdict::no_mismatch;
  std::vector<NamedEffect> named;  ///< strongest first
  std::vector<ParameterOutcome> parameters;
  double gain_error = 0;
  bool gain_covered = false;
  double unseen_excess_removed = 0;  ///< of the window error of a recording that nobody fitted
  double window_error_m = 0;         ///< 0.5 s windows, refitted nominal model
  double noise_floor_m = 0;          ///< of those
  double time_s = 0;                 ///< processor time of the diagnosis, one thread
  /// What each baseline names on the same session, first the one it holds for strongest.
  std::map<std::string, std::vector<std::string>> baselines;
  double baselines_time_s = 0;

  bool outside() const { return expected.empty() && !asked.effects.empty() && !values_off(); }
  bool values_off() const { return !asked.effects.empty() && asked.effects.front() == "parameter_change"; }
  bool all_named() const;
  bool first_right() const;
  bool false_name() const;
  /// The right answer: every hidden effect named, or the verdict that says there is none to name.
  bool answered() const;
  /// Of the refitted nominal model's window error, what is above the floor, in units of the floor.
  double excess_over_floor() const;
};

enum class Ask { diagnosis, diagnosis_and_baselines };

/// Hides, records, diagnoses and compares, on the thread that calls.
Outcome ask(const Case& asked, Ask whom);

/// What is to be judged: the recordings, and the model that their cart's owner believes in.
struct Question {
  Session session;
  Model nominal;
};
Question question_of(const Case& asked);

/// The session and the nominal model of a case, as files to look at.
Result<void> write_case(const Case& asked, const std::filesystem::path& directory);

}  // namespace cartwright::blind
