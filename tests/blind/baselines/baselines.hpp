#pragma once

#include <map>

#include "host/diagnose/diagnosis.hpp"
#include "tests/blind/baselines/rules.hpp"

namespace cartwright::blind {

/// What each baseline names on a session, by the baseline's name; first what it holds for strongest. Those
/// that choose among likelihood fits start from the refitted nominal model and the screening of the
/// diagnosis, on the recordings it used.
std::map<std::string, Names> ask_baselines(const Session& session, const Model& nominal, const Diagnosis& d);

/// What each of them does, a sentence each, for a report.
std::vector<std::string> baseline_descriptions();

}  // namespace cartwright::blind
