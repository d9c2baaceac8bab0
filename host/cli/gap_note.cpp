#include "host/cli/gap_note.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "host/session/gaps.hpp"

namespace cartwright::cli {

void tell_gaps(const Session& session) {
  for (const std::string& line : gaps_in_words(session)) fmt::print(stderr, "cartwright: note: {}\n", line);
}

}  // namespace cartwright::cli
