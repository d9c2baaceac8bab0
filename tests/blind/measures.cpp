#include "tests/blind/measures.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "host/statistics/binomial.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright::blind {
namespace {

using Names = std::vector<std::string>;
using Kind = std::function<bool(const Outcome&)>;
/// Whether an answer is a success; `names` are what was named, by the diagnosis or a baseline.
using Judge = std::function<bool(const Outcome&, const Names& names)>;

bool one_effect(const Outcome& o) {
  return o.expected.size() == 1 && o.asked.effects.size() == 1;
}

bool first_right(const Outcome& o, const Names& names) {
  return !names.empty() && std::find(o.expected.begin(), o.expected.end(), names.front()) != o.expected.end();
}

bool any_wrong(const Outcome& o, const Names& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::find(o.expected.begin(), o.expected.end(), name) == o.expected.end();
  });
}

bool all_named(const Outcome& o, const Names& names) {
  return std::all_of(o.expected.begin(), o.expected.end(), [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

Names names_of(const Outcome& o) {
  Names names;
  for (const NamedEffect& n : o.named) names.push_back(n.name);
  return names;
}

/// Counts successes of the diagnosis, and of each baseline where it was asked.
class Counter {
 public:
  void count(const Outcome& o, bool ours, const Judge& judge) {
    add(ours_, ours);
    for (const auto& [baseline, names] : o.baselines) add(theirs_[baseline], judge(o, names));
  }
  std::size_t cases() const { return static_cast<std::size_t>(ours_.cases); }
  Estimate ours() const { return binomial_share(ours_.hits, ours_.cases); }
  std::map<std::string, Estimate> theirs() const {
    std::map<std::string, Estimate> shares;
    for (const auto& [baseline, c] : theirs_) shares[baseline] = binomial_share(c.hits, c.cases);
    return shares;
  }

 private:
  struct Count {
    int hits = 0, cases = 0;
  };
  static void add(Count& count, bool hit) { count.hits += hit, ++count.cases; }
  Count ours_;
  std::map<std::string, Count> theirs_;
};

Estimate times(Estimate e, double factor) {
  return {e.value * factor, e.low * factor, e.high * factor};
}

class Table {
 public:
  explicit Table(const Outcomes& outcomes) : outcomes_(outcomes) {}

  /// A share in per cent; `ours` where the diagnosis' answer is more than its names.
  void share(const std::string& name, const Kind& kind, const Judge& judge, double target_percent,
             bool at_most = false, const Kind& ours = {}) {
    Counter counter;
    for (const Outcome& o : outcomes_) {
      if (kind(o)) counter.count(o, ours ? ours(o) : judge(o, names_of(o)), judge);
    }
    if (counter.cases() == 0) return;
    const Estimate reached = times(counter.ours(), 100);
    const bool met = at_most ? reached.value <= target_percent : reached.value >= target_percent;
    Measure m{name,
              (at_most ? "at most " : "at least ") + percent(target_percent),
              "%",
              reached,
              counter.cases(),
              met,
              {}};
    for (const auto& [baseline, e] : counter.theirs()) m.baselines[baseline] = times(e, 100);
    rows.push_back(std::move(m));
  }

  void quantile_of(const std::string& name, const std::vector<double>& values, double at, double factor,
                   const std::string& unit, double target, bool at_most = true) {
    if (values.empty()) return;
    const Estimate reached = times(quantile(values, at), factor);
    const bool met = at_most ? reached.value <= target : reached.value >= target;
    rows.push_back({name,
                    (at_most ? "at most " : "at least ") + text(target) + " " + unit,
                    unit,
                    reached,
                    values.size(),
                    met,
                    {}});
  }

  std::vector<Measure> rows;

 private:
  static std::string text(double value) {
    std::string digits = std::to_string(value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
  }
  static std::string percent(double value) { return text(value) + " %"; }

  const Outcomes& outcomes_;
};

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values;
}

Detection detection(std::string label, const std::vector<const Outcome*>& group) {
  Detection d;
  d.label = std::move(label);
  Counter counter;
  double logarithms = 0;
  for (const Outcome* o : group) {
    counter.count(*o, o->first_right(), first_right);
    logarithms += std::log(std::max(o->excess_over_floor(), 1e-3));
  }
  d.cases = group.size();
  d.excess_over_floor = std::exp(logarithms / static_cast<double>(group.size()));
  d.named_first = counter.ours();
  d.baselines = counter.theirs();
  return d;
}

}  // namespace

Estimate quantile(std::vector<double> values, double share) {
  values = finite(std::move(values));
  if (values.empty()) return {std::nan("")};
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size()), last = n - 1;
  const auto at = [&](double rank) {
    const double r = std::clamp(rank, 0.0, last);
    const auto below = static_cast<std::size_t>(r);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (r - std::floor(r)) * (values[above] - values[below]);
  };
  // The number of values below the true quantile is binomial.
  if (share <= 0 || share >= 1) return {at(share * last)};  // the greatest says nothing of what might be
  const double spread = normal(0.95) * std::sqrt(n * share * (1 - share));
  return {at(share * last), at(std::floor(n * share - spread) - 1), at(std::ceil(n * share + spread))};
}

std::vector<Measure> measures(const Outcomes& outcomes) {
  Table table(outcomes);
  const double named_first[] = {75, 92, 97, 97};
  for (const int size : {3, 2, 1, 0}) {
    table.share(
        "named first, " + std::string(name(static_cast<Size>(size))),
        [size](const Outcome& o) { return one_effect(o) && static_cast<int>(o.asked.size) == size; },
        first_right, named_first[size]);
  }
  table.share("a wrong name given to an effect of the vocabulary", one_effect, any_wrong, 2, true);
  table.share(
      "false alarms where nothing is hidden", [](const Outcome& o) { return o.asked.effects.empty(); },
      [](const Outcome&, const Names& names) { return !names.empty(); }, 2, true,
      [](const Outcome& o) { return o.verdict != Verdict::no_mismatch; });
  table.share(
      "values off, and said so", [](const Outcome& o) { return o.values_off(); },
      [](const Outcome&, const Names& names) { return names.empty(); }, 95, false,
      [](const Outcome& o) { return o.verdict == Verdict::parameters_only; });
  table.share(
      "medium and large physics without a name refused",
      [](const Outcome& o) { return o.outside() && o.asked.size >= Size::medium; },
      [](const Outcome&, const Names& names) { return names.empty(); }, 95, false,
      [](const Outcome& o) { return o.verdict == Verdict::unexplained; });
  table.share(
      "both of two medium effects named", [](const Outcome& o) { return o.expected.size() == 2; }, all_named,
      85);

  std::vector<double> errors, gain_errors, removed, time_s;
  int covered = 0, gain_covered = 0;
  for (const Outcome& o : outcomes) {
    time_s.push_back(o.time_s);
    if (o.outside()) continue;
    gain_errors.push_back(o.gain_error);
    gain_covered += o.gain_covered;
    for (const ParameterOutcome& p : o.parameters) errors.push_back(p.relative_error), covered += p.covered;
    if (o.asked.size >= Size::medium && std::isfinite(o.unseen_excess_removed))
      removed.push_back(o.unseen_excess_removed);
  }
  table.quantile_of("parameters of effects, median error", errors, 0.5, 100, "%", 1);
  table.quantile_of("parameters of effects, 90th percentile of the error", errors, 0.9, 100, "%", 10);
  const auto coverage = [&](const char* name, int inside, std::size_t all) {
    if (all == 0) return;
    const Estimate share = times(binomial_share(inside, static_cast<int>(all)), 100);
    table.rows.push_back({name, "90 to 98 %", "%", share, all, share.value >= 90 && share.value <= 98, {}});
  };
  coverage("parameters of effects, truth in the 95 % interval", covered, errors.size());
  table.quantile_of("voltage gain, 90th percentile of the error", gain_errors, 0.9, 100, "%", 0.3);
  coverage("voltage gain, truth in the 95 % interval", gain_covered, gain_errors.size());
  table.quantile_of("excess error removed on recordings never seen, median", removed, 0.5, 100, "%", 98,
                    false);
  table.quantile_of("excess error removed on recordings never seen, 10th percentile", removed, 0.1, 100, "%",
                    85, false);
  table.quantile_of("processor time, median", time_s, 0.5, 1, "s", 8);
  table.quantile_of("processor time, worst", time_s, 1, 1, "s", 30);
  return std::move(table.rows);
}

std::vector<ReliabilityBin> reliability(const Outcomes& outcomes) {
  std::vector<ReliabilityBin> bins;
  const double edges[] = {0, 0.3, 0.6, 0.8, 0.9, 0.95, 1};
  for (std::size_t i = 0; i + 1 < std::size(edges); ++i) {
    ReliabilityBin bin;
    bin.low = edges[i], bin.high = edges[i + 1];
    for (const Outcome& o : outcomes) {
      for (const NamedEffect& n : o.named) {
        if (n.confidence < bin.low || (n.confidence >= bin.high && bin.high < 1)) continue;
        ++bin.names, bin.right += n.right, bin.stated += n.confidence;
      }
    }
    if (bin.names == 0) continue;
    bin.stated /= bin.names;
    bin.share_right = binomial_share(bin.right, bin.names);
    bins.push_back(bin);
  }
  return bins;
}

std::vector<Detection> detection_by_size(const Outcomes& outcomes) {
  std::vector<Detection> list;
  for (const int size : {0, 1, 2, 3}) {
    std::vector<const Outcome*> group;
    for (const Outcome& o : outcomes) {
      if (one_effect(o) && static_cast<int>(o.asked.size) == size) group.push_back(&o);
    }
    if (!group.empty()) list.push_back(detection(std::string(name(static_cast<Size>(size))), group));
  }
  return list;
}

std::vector<Detection> detection_by_excess(const Outcomes& outcomes, std::size_t groups) {
  std::vector<const Outcome*> all;
  for (const Outcome& o : outcomes) {
    if (one_effect(o) && std::isfinite(o.excess_over_floor())) all.push_back(&o);
  }
  std::sort(all.begin(), all.end(), [](const Outcome* a, const Outcome* b) {
    return a->excess_over_floor() < b->excess_over_floor();
  });
  std::vector<Detection> list;
  for (std::size_t g = 0; g < groups; ++g) {
    const auto from = static_cast<std::ptrdiff_t>(g * all.size() / groups);
    const auto to = static_cast<std::ptrdiff_t>((g + 1) * all.size() / groups);
    if (from < to) list.push_back(detection("", {all.begin() + from, all.begin() + to}));
  }
  return list;
}

std::vector<EffectRow> by_effect(const Outcomes& outcomes) {
  std::map<std::string, EffectRow> rows;
  std::map<std::string, std::vector<double>> errors;
  for (const Outcome& o : outcomes) {
    if (o.asked.effects.size() != 1 || o.values_off()) continue;
    EffectRow& row = rows[o.asked.effects.front()];
    auto& [right, cases] = row.right_of[static_cast<int>(o.asked.size)];
    ++cases, right += o.answered();
    for (const ParameterOutcome& p : o.parameters) {
      errors[o.asked.effects.front()].push_back(p.relative_error);
      ++row.parameters, row.covered += p.covered;
    }
  }
  std::vector<EffectRow> list;
  for (auto& [effect, row] : rows) {
    row.effect = effect;
    row.median_error = quantile(errors[effect], 0.5);
    row.worst_tenth_error = quantile(errors[effect], 0.9);
    list.push_back(row);
  }
  return list;
}

std::vector<std::string> baselines_asked(const Outcomes& outcomes) {
  std::set<std::string> names;
  for (const Outcome& o : outcomes) {
    for (const auto& [baseline, named] : o.baselines) names.insert(baseline);
  }
  return {names.begin(), names.end()};
}

}  // namespace cartwright::blind
