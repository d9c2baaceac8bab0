#include "tests/blind/cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <random>

namespace cartwright::blind {
namespace {

std::vector<Case> one_each(const std::vector<std::string>& effects, const Draws& draws) {
  std::vector<Case> cases;
  for (std::uint64_t seed = draws.first; seed < draws.first + draws.seeds; ++seed) {
    std::uint64_t cart = 100 * seed;
    for (const int size : draws.sizes) {
      for (const std::string& effect : effects)
        cases.push_back({{effect}, static_cast<Size>(size), cart++, draws.recordings, draws.instruments});
    }
  }
  return cases;
}

Case pair(std::uint64_t seed, const Draws& draws) {
  std::mt19937_64 random(seed);
  const auto& list = effects_of_the_vocabulary();
  const std::size_t a = random() % list.size(), b = (a + 1 + random() % (list.size() - 1)) % list.size();
  return {{list[a], list[b]}, Size::medium, seed, draws.recordings, draws.instruments};
}

}  // namespace

std::string effects_of(const Case& asked) {
  return asked.effects.empty() ? "nothing" : fmt::format("{}", fmt::join(asked.effects, "+"));
}

const std::vector<std::string>& sets() {
  static const std::vector<std::string> names{"effects", "laws",  "pairs", "outside",
                                              "foreign", "clean", "change"};
  return names;
}

std::vector<Case> cases_of(const std::string& set, const Draws& draws) {
  std::vector<Case> cases;
  if (set == "all") {
    for (const std::string& one : sets()) {
      const std::vector<Case> more = cases_of(one, draws);
      cases.insert(cases.end(), more.begin(), more.end());
    }
  }
  if (set == "effects") return one_each(effects_of_the_vocabulary(), draws);
  if (set == "laws") return one_each(effects_by_other_laws(), draws);
  if (set == "outside") return one_each(effects_outside(), draws);
  if (set == "foreign") return one_each(effects_foreign(), draws);
  for (std::uint64_t seed = draws.first; seed < draws.first + draws.seeds; ++seed) {
    if (set == "clean") cases.push_back({{}, Size::medium, seed, draws.recordings, draws.instruments});
    if (set == "change")
      cases.push_back({{"parameter_change"}, Size::medium, seed, draws.recordings, draws.instruments});
    if (set == "pairs") cases.push_back(pair(seed, draws));
  }
  return cases;
}

}  // namespace cartwright::blind
