#include "tests/blind/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cartwright::blind {
namespace {

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

std::string kind(const Outcome& o) {
  if (o.asked.effects.empty()) return "nothing hidden";
  if (o.asked.effects.size() > 1) return "two effects, " + std::string(name(o.asked.size));
  if (o.values_off()) return "values off";
  if (o.outside()) return "outside, " + std::string(name(o.asked.size));
  return "one effect, " + std::string(name(o.asked.size));
}

struct Count {
  int cases = 0, right = 0, wrong_name = 0;
};

}  // namespace

std::string summary(const std::vector<Outcome>& outcomes) {
  std::map<std::string, Count> counts;
  std::map<int, Count> sure;
  std::vector<double> errors, gain_errors, removed, times;
  int covered = 0, gain_covered = 0;
  for (const Outcome& o : outcomes) {
    Count& count = counts[kind(o)];
    ++count.cases;
    count.right += o.answered();
    count.wrong_name += o.false_name();
    for (const NamedEffect& n : o.named) {
      Count& bin = sure[static_cast<int>(std::min(n.confidence, 0.999) * 5)];
      ++bin.cases;
      bin.right += n.right;
    }
    times.push_back(o.time_s);
    if (o.outside()) continue;
    for (const ParameterOutcome& p : o.parameters) {
      errors.push_back(p.relative_error);
      covered += p.covered;
    }
    gain_errors.push_back(o.gain_error);
    gain_covered += o.gain_covered;
    if (o.asked.size >= Size::medium) removed.push_back(o.unseen_excess_removed);
  }
  std::string text =
      fmt::format("\n{:32s} {:>6s} {:>14s} {:>11s}\n", "", "cases", "right answer", "wrong name");
  for (const auto& [what, c] : counts) {
    text += fmt::format("{:32s} {:6d} {:13.1f}% {:10.1f}%\n", what, c.cases, 100.0 * c.right / c.cases,
                        100.0 * c.wrong_name / c.cases);
  }
  const auto percent = [](int part, std::size_t all) {
    return all > 0 ? 100.0 * part / static_cast<double>(all) : std::nan("");
  };
  text += fmt::format(
      "\nparameters of effects: error median {:.2f} %, 90th percentile {:.2f} %; intervals cover {:.1f} % of "
      "{}\n",
      100 * quantile(errors, 0.5), 100 * quantile(errors, 0.9), percent(covered, errors.size()),
      errors.size());
  text += fmt::format("voltage gain: error 90th percentile {:.3f} %; intervals cover {:.1f} %\n",
                      100 * quantile(gain_errors, 0.9), percent(gain_covered, gain_errors.size()));
  text += fmt::format(
      "excess window error removed on recordings never seen, medium and large: median {:.1f} %, 10th "
      "percentile {:.1f} %\n",
      100 * quantile(removed, 0.5), 100 * quantile(removed, 0.1));
  text += fmt::format("processor time: median {:.1f} s, worst {:.1f} s\n", quantile(times, 0.5),
                      quantile(times, 1));
  text += "how sure it was of a name, and how often that was right:\n";
  for (const auto& [bin, c] : sure) {
    text += fmt::format("  {:.1f} to {:.1f}: {:3d} of {:3d}\n", 0.2 * bin, 0.2 * (bin + 1), c.right, c.cases);
  }
  return text;
}

}  // namespace cartwright::blind
