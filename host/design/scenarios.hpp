#pragma once

#include <cstdint>
#include <vector>

#include "common/config/interval_toml.hpp"
#include "common/model/model.hpp"
#include "host/design/specification.hpp"
#include "host/design/step_test.hpp"

namespace cartwright::design {

/// One cart the gains may meet.
struct Scenario {
  Model model;
  bool warm = false;  ///< its motor heated through
};

/// The model itself first, then a sample of the box that the intervals span (within the physical bounds of
/// each parameter): corners (all of them where there are at most 16, else 8 opposite pairs drawn at random),
/// both ends of every interval with the others at their values, and `inside` points within. A motor that
/// heats up is taken warm in every second one, and once with the model itself. The box disregards that the
/// errors of fitted numbers go together, so the worst case over it is on the safe side. The same arguments
/// give the same sample.
std::vector<Scenario> sample_scenarios(const Model& model, const std::vector<ParameterInterval>& intervals,
                                       std::size_t inside = 8, std::uint64_t seed = 1);

/// Whether a step down differs from a step up: pushes, asymmetries and what depends on the position.
bool direction_matters(const Model& model);

/// What the gains are judged on: every scenario, stepped up from the start and, where that is not the same,
/// down again.
struct Trials {
  std::vector<Scenario> scenarios;  ///< at least one, the nominal first
  std::size_t mapped = 0;           ///< as many of the first are looked at all over a map, all for a proposal
  Loop loop;
  StepTest step;
  Specification specification;

  /// Fills in what the specification asks of the step test.
  Trials(std::vector<Scenario> carts, const Loop& loop_settings, StepTest step_test,
         const Specification& spec);

  /// Each quantity's worse one of the directions.
  StepMetrics metrics(const Scenario& scenario, const Gains& gains) const;

  struct Worst {
    Verdict verdict;           ///< of the scenario with the least slack
    double rms_voltage_V = 0;  ///< the greatest
  };
  /// Over all scenarios.
  Worst worst(const Gains& gains) const;
  /// Whether the first `count` scenarios meet the specification, beginning with number `first`, which is then
  /// the one that did not: as likely as not the next gains fail there too. The worst of them, or the one that
  /// failed.
  Worst meets(const Gains& gains, std::size_t count, std::size_t& first) const;
  bool all_meet(const Gains& gains) const;
};

}  // namespace cartwright::design
