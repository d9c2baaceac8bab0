#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cartwright::cli {

/// A bash script that completes every command and option of the program. It is made from the same description
/// that parses the command line, so it cannot go stale. Values that are one of a few words are completed as
/// those, all others as file names.
std::string bash_completion(const CLI::App& app);

}  // namespace cartwright::cli
