#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "host/diagnose/diagnosis.hpp"
#include "tests/blind/concealed.hpp"

namespace cartwright::blind {

/// One question put to the diagnosis.
struct Case {
  std::vector<std::string> effects;  ///< none: a session without any
  Size size = Size::medium;
  std::uint64_t seed = 1;
};

/// One name given, and whether it was right.
struct NamedEffect {
  std::string name;
  double confidence = 0;
  bool right = false;
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
  double time_s = 0;                 ///< of the diagnosis, on the threads it was given

  bool all_named() const;
  bool first_right() const;
  bool false_name() const;
};

/// Hides, records, diagnoses and compares.
Outcome ask(const Case& asked, unsigned threads);

/// The session and the nominal model of a case, as files to look at.
Result<void> write_case(const Case& asked, const std::filesystem::path& directory);

}  // namespace cartwright::blind
