#pragma once

#include <string>

#include "host/diagnose/search/explain.hpp"

namespace cartwright {

/// A push that gets a name is the only one of its kind. In words, after "with it", where another one is left
/// in the errors that promises half of what the named one gained; empty where none is, or none was named.
std::string further_push(const Session& session, const Search& search, FitOptions options);

}  // namespace cartwright
