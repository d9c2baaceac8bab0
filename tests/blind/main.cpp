// Hides physics in carts of its own and asks the diagnosis what it is: one line a case, and a table at the
// end.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <mutex>
#include <thread>

#include "tests/blind/benchmark_page.hpp"
#include "tests/blind/measures.hpp"
#include "tests/blind/null.hpp"
#include "tests/blind/saved.hpp"
#include "tests/blind/summary.hpp"

namespace {

using namespace cartwright;
using namespace cartwright::blind;

struct Options {
  std::vector<std::string> sets{"effects"};
  Draws draws;
  unsigned jobs = 2;
  std::vector<std::string> only;
  bool baselines = false;
  std::size_t surrogates = 0;
  std::string write, save, report;
};

std::vector<Case> cases_of(const Options& options) {
  std::vector<Case> cases;
  for (const std::string& set : options.sets) {
    const std::vector<Case> more = blind::cases_of(set, options.draws);
    cases.insert(cases.end(), more.begin(), more.end());
  }
  if (!options.only.empty()) {
    std::erase_if(cases, [&](const Case& c) {
      return std::find(options.only.begin(), options.only.end(), effects_of(c)) == options.only.end();
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
             effects_of(o.asked), blind::name(o.asked.size), o.asked.seed, cartwright::name(o.verdict), named,
             numbers, 100 * o.gain_error, o.gain_covered ? "" : "*", o.unseen_excess_removed, o.time_s);
  for (const auto& [baseline, names] : o.baselines)
    fmt::print("    {:34s} {}\n", baseline, fmt::join(names, " "));
  std::fflush(stdout);
}

int write(const std::vector<Case>& cases, const std::filesystem::path& directory) {
  for (const Case& c : cases) {
    const auto where = directory / fmt::format("{}_{}", effects_of(c), c.seed);
    std::filesystem::create_directories(directory);
    if (const auto written = write_case(c, where); !written) {
      fmt::print(stderr, "blind_proof: {}\n", written.error().message);
      return 2;
    }
    for (const auto& [key, value] : draw(c.effects, c.size, c.seed, c.instruments).truth)
      fmt::print("{}: {} = {}\n", where.string(), key, value);
  }
  return 0;
}

/// The greatest gains that the search finds in surrogates of clean sessions, beside what an effect must gain.
int null(const Options& options) {
  std::vector<double> all;
  for (const Case& c : blind::cases_of("clean", options.draws)) {
    const Question q = question_of(c);
    for (const double gain : greatest_gains_of_nothing(q.session, q.nominal, options.surrogates, c.seed)) {
      all.push_back(gain);
      fmt::print("draw {}, surrogate {}: {:.2f} nats\n", c.seed, all.size(), gain);
      std::fflush(stdout);
    }
  }
  const auto beyond = std::count_if(all.begin(), all.end(), [](double g) { return g >= kLeastGain; });
  fmt::print(
      "greatest gain found in {} surrogates: median {:.2f}, 90th percentile {:.2f}, most {:.2f} nats; "
      "{} reach the {} that an effect must gain\n",
      all.size(), quantile(all, 0.5).value, quantile(all, 0.9).value, quantile(all, 1).value, beyond,
      kLeastGain);
  return 0;
}

/// Asks what the file of saved outcomes does not hold yet, and adds each answer to it.
Result<std::vector<Outcome>> ask_all(std::vector<Case> cases, const Options& options) {
  std::vector<Outcome> outcomes;
  if (!options.save.empty()) {
    drop_unfinished_line(options.save);
    auto saved = read_outcomes(options.save);
    if (!saved) return saved;
    outcomes = std::move(*saved);
    const std::size_t all = cases.size();
    std::erase_if(cases, [&](const Case& c) {
      return std::any_of(outcomes.begin(), outcomes.end(), [&](const Outcome& o) {
        return o.asked == c && (!options.baselines || !o.baselines.empty());
      });
    });
    fmt::print(stderr, "{}: {} outcomes, {} of {} cases still to do\n", options.save, outcomes.size(),
               cases.size(), all);
  }
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::string trouble;
  std::mutex one_at_a_time;
  std::vector<std::jthread> workers;
  for (unsigned j = 0; j < options.jobs; ++j) {
    workers.emplace_back([&] {
      for (std::size_t i = next++; i < cases.size(); i = next++) {
        Outcome outcome = ask(cases[i], options.baselines ? Ask::diagnosis_and_baselines : Ask::diagnosis);
        const std::lock_guard lock(one_at_a_time);
        print(outcome);
        fmt::print(stderr, "{} of {}\r", ++done, cases.size());
        if (!options.save.empty()) {
          if (const auto saved = append_outcome(outcome, options.save); !saved)
            trouble = saved.error().message;
        }
        std::erase_if(outcomes, [&](const Outcome& o) { return o.asked == outcome.asked; });
        outcomes.push_back(std::move(outcome));
      }
    });
  }
  workers.clear();
  if (!trouble.empty()) return failure(trouble);
  return outcomes;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Hides physics in carts of its own and asks the diagnosis what it is");
  Options options;
  std::vector<std::string> names = sets();
  names.emplace_back("all");
  app.add_option("--set", options.sets, "what to hide; several, or all")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_option("--sizes", options.draws.sizes, "0 a third of small, 1 small, 2 medium, 3 large")
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  app.add_option("--seeds", options.draws.seeds, "how many draws")->capture_default_str();
  app.add_option("--first", options.draws.first, "the first seed")->capture_default_str();
  app.add_option("--recordings", options.draws.recordings, "only the first so many of each battery")
      ->check(CLI::Range(1, 10))
      ->capture_default_str();
  app.add_option("--rate", options.draws.instruments.sample_rate_hz, "sample rate [Hz]")
      ->check(CLI::Range(100, 10000))
      ->capture_default_str();
  app.add_option("--count", options.draws.instruments.count_m, "resolution of the encoder [m]")
      ->check(CLI::Range(1e-6, 1e-3))
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "sessions at a time, one thread each")->capture_default_str();
  app.add_option("--only", options.only, "only these effects");
  app.add_flag("--baselines", options.baselines, "put the same sessions to the baselines as well");
  app.add_option("--null", options.surrogates,
                 "instead: so many surrogates of each clean session, and the greatest gain found in them");
  app.add_option("--save", options.save, "add each outcome to this file, and skip the cases it holds");
  app.add_option("--report", options.report, "make a page of the outcomes, those of the file included");
  app.add_option("--write", options.write, "write the sessions there, with their truth, and ask nothing");
  CLI11_PARSE(app, argc, argv);
  if (options.surrogates > 0) return null(options);
  const std::vector<Case> cases = cases_of(options);
  if (!options.write.empty()) return write(cases, options.write);
  const auto outcomes = ask_all(cases, options);
  if (!outcomes) {
    fmt::print(stderr, "blind_proof: {}\n", outcomes.error().message);
    return 2;
  }
  fmt::print("{}", summary(*outcomes));
  if (options.report.empty()) return 0;
  if (const auto written = benchmark_page(*outcomes).write(options.report); !written) {
    fmt::print(stderr, "blind_proof: {}\n", written.error().message);
    return 2;
  }
}
