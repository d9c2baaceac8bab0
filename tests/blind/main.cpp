// Hides physics in carts of its own and asks the diagnosis what it is: one line a case, and a table at the
// end.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <mutex>
#include <thread>

#include "tests/blind/summary.hpp"

namespace {

using namespace cartwright;
using namespace cartwright::blind;

struct Options {
  std::string set = "effects";
  std::vector<int> sizes{2};
  std::uint64_t seeds = 1, first = 1;
  unsigned jobs = 2;
  std::vector<std::string> only;
  std::string write;
};

std::string join(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, "+"));
}

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> cases;
  for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
    if (options.set == "clean") cases.push_back({{}, Size::medium, seed});
    if (options.set == "change") cases.push_back({{"parameter_change"}, Size::medium, seed});
    if (options.set == "pairs") {
      std::mt19937_64 random(seed);
      const auto& list = effects_of_the_vocabulary();
      const std::size_t a = random() % list.size(), b = (a + 1 + random() % (list.size() - 1)) % list.size();
      cases.push_back({{list[a], list[b]}, Size::medium, seed});
    }
    if (options.set != "effects" && options.set != "outside") continue;
    std::uint64_t cart = 100 * seed;  // every case a cart of its own
    const auto& list = options.set == "effects" ? effects_of_the_vocabulary() : effects_outside();
    for (const int size : options.sizes) {
      for (const auto& effect : list) cases.push_back({{effect}, static_cast<Size>(size), cart++});
    }
  }
  if (!options.only.empty()) {
    std::erase_if(cases, [&](const Case& c) {
      return std::find(options.only.begin(), options.only.end(), join(c.effects)) == options.only.end();
    });
  }
  return cases;
}

/// `!` marks a wrong name, `*` an interval that misses the truth.
void print(const Outcome& o) {
  std::string named, numbers;
  for (const NamedEffect& n : o.named)
    named += fmt::format(" {}{}:{:.2f}", n.right ? "" : "!", n.name, n.confidence);
  for (const ParameterOutcome& p : o.parameters) {
    numbers += fmt::format(" {}:{:.2f}%{}", p.name.substr(p.name.find('.') + 1), 100 * p.relative_error,
                           p.covered ? "" : "*");
  }
  fmt::print("{:28s} {:14s} {:5d} => {:15s}{} |{} | gain {:.3f}%{} removed {:.3f} {:.1f} s\n",
             join(o.asked.effects), blind::name(o.asked.size), o.asked.seed, cartwright::name(o.verdict),
             named, numbers, 100 * o.gain_error, o.gain_covered ? "" : "*", o.unseen_excess_removed,
             o.time_s);
  std::fflush(stdout);
}

int write(const std::vector<Case>& cases, const std::filesystem::path& directory) {
  for (const Case& c : cases) {
    const auto where =
        directory / fmt::format("{}_{}", c.effects.empty() ? "nothing" : join(c.effects), c.seed);
    std::filesystem::create_directories(directory);
    if (const auto written = write_case(c, where); !written) {
      fmt::print(stderr, "blind_proof: {}\n", written.error().message);
      return 2;
    }
    for (const auto& [key, value] : draw(c.effects, c.size, c.seed).truth)
      fmt::print("{}: {} = {}\n", where.string(), key, value);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Hides physics in carts of its own and asks the diagnosis what it is");
  Options options;
  app.add_option("--set", options.set, "what to hide")
      ->check(CLI::IsMember({"effects", "pairs", "outside", "clean", "change"}))
      ->capture_default_str();
  app.add_option("--sizes", options.sizes, "0 a third of small, 1 small, 2 medium, 3 large")
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "how many draws")->capture_default_str();
  app.add_option("--first", options.first, "the first seed")->capture_default_str();
  app.add_option("--jobs", options.jobs, "sessions at a time, one thread each")->capture_default_str();
  app.add_option("--only", options.only, "only these effects");
  app.add_option("--write", options.write, "write the sessions there, with their truth, and ask nothing");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Case> cases = cases_of(options);
  if (!options.write.empty()) return write(cases, options.write);
  std::vector<Outcome> outcomes;
  std::atomic<std::size_t> next = 0;
  std::mutex printing;
  std::vector<std::jthread> workers;
  for (unsigned j = 0; j < options.jobs; ++j) {
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < cases.size(); i = next++) {
        Outcome outcome = ask(cases[i], 1);
        const std::lock_guard lock(printing);
        print(outcome);
        outcomes.push_back(std::move(outcome));
      }
    });
  }
  workers.clear();
  fmt::print("{}", summary(outcomes));
}
