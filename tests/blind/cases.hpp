#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/blind/concealed.hpp"

namespace cartwright::blind {

/// One question put to the diagnosis.
struct Case {
  std::vector<std::string> effects;  ///< none: a session without any
  Size size = Size::medium;
  std::uint64_t seed = 1;
  std::size_t recordings = 10;  ///< how many of the battery's ten are there to be judged
  Instruments instruments = {};

  bool operator==(const Case&) const = default;
};

/// The effects joined by a plus; "nothing" where there are none.
std::string effects_of(const Case& asked);

/// Which cases to make: `seeds` draws from `first` on.
struct Draws {
  std::vector<int> sizes{2};
  std::uint64_t first = 1, seeds = 1;
  std::size_t recordings = 10;
  Instruments instruments = {};
};

/// Names of the sets: effects, pairs, outside, clean, change; and all of them, in that order.
const std::vector<std::string>& sets();

/// The cases of a set. Effects and what is outside the vocabulary come in every size asked for, each on a
/// cart of its own; pairs, clean carts and carts whose values are off have no size but the medium one.
std::vector<Case> cases_of(const std::string& set, const Draws& draws);

}  // namespace cartwright::blind
