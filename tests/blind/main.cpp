// Hides physics in carts of its own and asks the diagnosis what it is. Prints what came out, one line a case.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <mutex>
#include <thread>

#include "tests/blind/outcome.hpp"

namespace {

using namespace cartwright;
using namespace cartwright::blind;

std::string join(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, "+"));
}

void print(const Outcome& o) {
  std::string named, numbers;
  for (const NamedEffect& n : o.named)
    named += fmt::format(" {}{}:{:.2f}", n.right ? "" : "!", n.name, n.confidence);
  for (const ParameterOutcome& p : o.parameters)
    numbers += fmt::format(" {}:{:.2f}%{}", p.name.substr(p.name.find('.') + 1), 100 * p.relative_error,
                           p.covered ? "" : "*");
  fmt::print("{:28s} {:14s} {:5d} => {:15s}{} |{} | gain {:.3f}%{} removed {:.3f} {:.1f} s\n",
             join(o.asked.effects), blind::name(o.asked.size), o.asked.seed, cartwright::name(o.verdict),
             named, numbers, 100 * o.gain_error, o.gain_covered ? "" : "*", o.unseen_excess_removed,
             o.time_s);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Concealed physics, put to the diagnosis");
  std::string set = "effects";
  std::vector<int> sizes{2};
  std::uint64_t seeds = 1, first = 1;
  unsigned jobs = 2;
  std::vector<std::string> only;
  std::string write;
  app.add_option("--set", set);
  app.add_option("--sizes", sizes);
  app.add_option("--seeds", seeds);
  app.add_option("--first", first);
  app.add_option("--jobs", jobs);
  app.add_option("--only", only);
  app.add_option("--write", write);
  CLI11_PARSE(app, argc, argv);
  std::vector<Case> cases;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    if (set == "clean") cases.push_back({{}, Size::medium, seed});
    if (set == "change") cases.push_back({{"parameter_change"}, Size::medium, seed});
    if (set == "pairs") {
      std::mt19937_64 random(seed);
      const auto& list = effects_of_the_vocabulary();
      const std::size_t a = random() % list.size(), b = (a + 1 + random() % (list.size() - 1)) % list.size();
      cases.push_back({{list[a], list[b]}, Size::medium, seed});
    }
    std::uint64_t cart = 100 * seed;  // every case a cart of its own
    for (const int size : sizes) {
      if (set == "effects")
        for (const auto& e : effects_of_the_vocabulary())
          cases.push_back({{e}, static_cast<Size>(size), cart++});
      if (set == "outside")
        for (const auto& e : effects_outside()) cases.push_back({{e}, static_cast<Size>(size), cart++});
    }
  }
  if (!only.empty())
    std::erase_if(cases, [&](const Case& c) {
      return std::find(only.begin(), only.end(), join(c.effects)) == only.end();
    });
  if (!write.empty()) {
    for (const Case& c : cases)
      if (auto done =
              write_case(c, std::filesystem::path(write) / fmt::format("{}_{}", join(c.effects), c.seed));
          !done)
        fmt::print("{}\n", done.error().message);
    for (const Case& c : cases) {
      const Concealed hidden = draw(c.effects, c.size, c.seed);
      for (const auto& [key, value] : hidden.truth)
        fmt::print("{}_{}: {} = {}\n", join(c.effects), c.seed, key, value);
      const auto& p = hidden.physics;
      fmt::print("  gain {} viscous {} coulomb {} shares {} {} {}\n", p.gain_m_per_s2_V, p.viscous_per_s,
                 p.coulomb_m_per_s2, p.load_share, p.load_friction_share, p.load_damping_share);
    }
    return 0;
  }
  std::atomic<std::size_t> next = 0;
  std::mutex printing;
  std::vector<std::thread> workers;
  for (unsigned j = 0; j < jobs; ++j)
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < cases.size(); i = next++) {
        const Outcome o = ask(cases[i], 1, false);
        const std::lock_guard lock(printing);
        print(o);
      }
    });
  for (auto& w : workers) w.join();
}
