#include "tests/blind/summary.hpp"

#include <fmt/format.h>

#include <map>

#include "tests/blind/measures.hpp"

namespace cartwright::blind {
namespace {

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
  for (const Outcome& o : outcomes) {
    Count& count = counts[kind(o)];
    ++count.cases, count.right += o.answered(), count.wrong_name += o.false_name();
  }
  std::string text =
      fmt::format("\n{:32s} {:>6s} {:>14s} {:>11s}\n", "", "cases", "right answer", "wrong name");
  for (const auto& [what, c] : counts) {
    text += fmt::format("{:32s} {:6d} {:13.1f}% {:10.1f}%\n", what, c.cases, 100.0 * c.right / c.cases,
                        100.0 * c.wrong_name / c.cases);
  }
  text += "\n";
  for (const Measure& m : measures(outcomes)) {
    text += fmt::format("{:66s} {:>14s}  {:8.3g} {} [{:.3g}, {:.3g}] of {}{}\n", m.name, m.target,
                        m.reached.value, m.unit, m.reached.low, m.reached.high, m.cases, m.met ? "" : "  -");
    for (const auto& [baseline, share] : m.baselines)
      text += fmt::format("    {:62s} {:>14s}  {:8.3g} {}\n", baseline, "", share.value, m.unit);
  }
  text += "\nhow sure it was of a name, and how often that was right:\n";
  for (const ReliabilityBin& bin : reliability(outcomes)) {
    text += fmt::format("  {:.2f} to {:.2f}, mean {:.3f}: {:4d} of {:4d} = {:.3f} [{:.3f}, {:.3f}]\n",
                        bin.low, bin.high, bin.stated, bin.right, bin.names, bin.share_right.value,
                        bin.share_right.low, bin.share_right.high);
  }
  return text;
}

}  // namespace cartwright::blind
