#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/blind/outcome.hpp"

namespace cartwright::blind {

/// Outcomes as lines of JSON, one each: a run of an hour can be stopped, taken up again, split over machines
/// and put together with `cat`.
std::string to_line(const Outcome& outcome);
Result<Outcome> from_line(const std::string& line);

/// All outcomes of a file, of a case asked twice the later; none if there is no such file. A last line
/// without an end, from a run that was stopped while it wrote, is left out.
Result<std::vector<Outcome>> read_outcomes(const std::filesystem::path& file);

/// Cuts off a last line without an end, so that the next one begins a line of its own.
void drop_unfinished_line(const std::filesystem::path& file);

/// Adds a line to the end of the file.
Result<void> append_outcome(const Outcome& outcome, const std::filesystem::path& file);

}  // namespace cartwright::blind
