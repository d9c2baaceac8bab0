#include "host/design/scenarios.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright::design {
namespace {

/// SplitMix64: a fixed sequence on every platform, which std::uniform_real_distribution does not promise.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

constexpr std::size_t kCorners = 16;
constexpr std::size_t kMapped = 10;

/// Within physical bounds, and without what has no width.
std::vector<ParameterInterval> usable(const std::vector<ParameterInterval>& intervals) {
  std::vector<ParameterInterval> out;
  for (ParameterInterval one : intervals) {
    const ParameterInfo& bounds = info(one.id);
    if (bounds.term == Term::external_disturbance) continue;
    one.low = std::clamp(one.low, bounds.lower, bounds.upper);
    one.high = std::clamp(one.high, bounds.lower, bounds.upper);
    if (one.low < one.high) out.push_back(one);
  }
  return out;
}

StepMetrics worse(const StepMetrics& a, const StepMetrics& b) {
  StepMetrics out = a;
  for (const QuantityInfo& q : quantities()) {
    const double other = b.*q.of;
    if (std::isnan(other) || (q.at_least ? other < a.*q.of : other > a.*q.of)) out.*q.of = other;
  }
  if (std::abs(b.final_error) > std::abs(a.final_error)) out.final_error = b.final_error;
  return out;
}

}  // namespace

std::vector<Scenario> sample_scenarios(const Model& model, const std::vector<ParameterInterval>& intervals,
                                       std::size_t inside, std::uint64_t seed) {
  std::vector<Scenario> out{{model, false}};
  const bool heats = model.has(Term::motor_heating);
  if (heats) out.push_back({model, true});
  const auto varied = usable(intervals);
  if (varied.empty()) return out;
  const auto add = [&](const auto& value_of) {
    Scenario one{model, heats && out.size() % 2 == 1};
    for (std::size_t i = 0; i < varied.size(); ++i) one.model.set(varied[i].id, value_of(i));
    out.push_back(one);
  };
  Random random(seed);
  const bool all_corners = varied.size() < 20 && (std::size_t{1} << varied.size()) <= kCorners;
  const std::size_t corners = all_corners ? std::size_t{1} << varied.size() : kCorners;
  // Opposite corners after each other: what comes first covers every interval.
  std::vector<char> high(varied.size());
  for (std::size_t corner = 0; corner < corners; ++corner) {
    for (std::size_t i = 0; i < varied.size(); ++i) {
      if (corner % 2 == 1) {
        high[i] = static_cast<char>(high[i] == 0);
      } else {
        high[i] = static_cast<char>(all_corners ? ((corner / 2) >> i & 1) != 0 : random.unit() < 0.5);
      }
    }
    add([&](std::size_t i) { return high[i] != 0 ? varied[i].high : varied[i].low; });
  }
  for (std::size_t end = 0; varied.size() > 1 && end < 2 * varied.size(); ++end) {
    add([&](std::size_t i) {
      if (i != end / 2) return model[varied[i].id];
      return end % 2 == 0 ? varied[i].low : varied[i].high;
    });
  }
  for (std::size_t k = 0; k < inside; ++k) {
    add([&](std::size_t i) { return varied[i].low + (varied[i].high - varied[i].low) * random.unit(); });
  }
  return out;
}

bool direction_matters(const Model& model) {
  for (const Term term :
       {Term::constant_force, Term::asymmetric_viscous_friction, Term::position_dependent_friction,
        Term::cogging, Term::cable_spring, Term::encoder_eccentricity, Term::encoder_missed_counts,
        Term::amplifier_gain_asymmetry}) {
    if (model.has(term)) return true;
  }
  return false;
}

Trials::Trials(std::vector<Scenario> carts, const Loop& loop_settings, StepTest step_test,
               const Specification& spec)
    : scenarios(std::move(carts)), loop(loop_settings), step(step_test), specification(spec) {
  mapped = std::min(scenarios.size(), kMapped);
  step.settling_band = spec.settling_band;
  step.bandwidth = spec[Quantity::bandwidth].has_value();
}

StepMetrics Trials::metrics(const Scenario& scenario, const Gains& gains) const {
  StepTest test = step;
  test.warm = scenario.warm;
  const StepMetrics up = step_metrics(scenario.model, gains, loop, test);
  if (!direction_matters(scenario.model)) return up;
  test.start_m = step.start_m + step.step_m;
  test.step_m = -step.step_m;
  return worse(up, step_metrics(scenario.model, gains, loop, test));
}

Trials::Worst Trials::worst(const Gains& gains) const {
  Worst out;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const StepMetrics found = metrics(scenarios[i], gains);
    const Verdict verdict = judge(specification, found);
    out.rms_voltage_V = std::max(out.rms_voltage_V, found.rms_voltage_V);
    if (i == 0 || verdict.slack < out.verdict.slack) out.verdict = verdict;
  }
  return out;
}

Trials::Worst Trials::meets(const Gains& gains, std::size_t count, std::size_t& first) const {
  Worst out;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (first + k) % count;
    const StepMetrics found = metrics(scenarios[i], gains);
    const Verdict verdict = judge(specification, found);
    out.rms_voltage_V = std::max(out.rms_voltage_V, found.rms_voltage_V);
    if (k == 0 || verdict.slack < out.verdict.slack) out.verdict = verdict;
    if (!verdict.met()) {
      first = i;
      break;
    }
  }
  return out;
}

bool Trials::all_meet(const Gains& gains) const {
  std::size_t first = 0;
  return meets(gains, scenarios.size(), first).verdict.met();
}

}  // namespace cartwright::design
