#pragma once

#include <string>
#include <vector>

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// What a reader should know beside a verdict: numbers that were held, a reversed sign, what this session
/// could not be asked. One sentence each.
std::vector<std::string> remarks(const Session& session, const Model& nominal,
                                 const std::vector<Parameter>& held, const Diagnosis& diagnosis);

}  // namespace cartwright
