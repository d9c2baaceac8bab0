#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "host/design/gain_map.hpp"
#include "host/statistics/estimate.hpp"

namespace cartwright::design {

struct SearchSettings {
  GainRange kp, kd;
  std::vector<IntegralPart> integrals{{}};  ///< one map for each; PD: one without
  std::size_t quarters = 24;                ///< coarse steps along each gain
  double margin = 0.1;                      ///< slack wanted of every limit in the worst scenario
  double gain_change = 0.05;  ///< each gain may be off by this part and the specification still holds
  unsigned threads = 1;
  std::function<void(std::string_view what, double share)> progress;
};

/// Where a step is expected to begin searching: Kp from a fiftieth of what the voltage limit allows at the
/// step's start to four times that, Kd from zero to half again what critical damping needs at the greatest
/// Kp, and integral times around the time in which the response must settle.
SearchSettings default_search(const Model& model, const Loop& loop, const StepTest& step,
                              const Specification& specification, bool integral);

/// The response of one gain set: nominal, and the least and greatest of all scenarios.
struct Prediction {
  std::array<Estimate, kQuantityCount> quantities;
  std::array<bool, kQuantityCount> always{};  ///< exists in every scenario (settles, rises)
  Estimate final_error;
  std::vector<double> t_s, y_m, y_low_m, y_high_m, u_V, u_low_V, u_high_V;
};

Prediction predict(const Trials& trials, const Gains& gains, unsigned threads = 1);

/// What could be had of one quantity if the other limits stay as they are.
struct Achievable {
  Quantity quantity = Quantity::settling_time;
  double asked = 0;
  double best = 0;  ///< of the model itself, on the points tried
};

struct Design {
  std::vector<GainMap> maps;
  /// The proposal: meets the specification in every scenario. None where nothing found does; `gains` are then
  /// the nearest.
  bool found = false;
  Gains gains;
  Verdict nominal, worst;
  bool has_margin = false;   ///< `margin` is left of every limit in the worst scenario
  bool may_change = false;   ///< it holds with each gain changed by `gain_change`, all signs together
  bool at_edge = false;      ///< of the range searched, other than zero
  bool model_alone = false;  ///< nothing found, but the model itself meets it somewhere
  std::vector<Achievable> achievable;  ///< where the model itself meets it nowhere: what each limit costs
  Prediction prediction;
};

/// Tries gains all over the range (GainMap) and proposes, among those with which every scenario keeps
/// `margin` of every limit and goes on doing so when the gains change a little, the ones that need the least
/// rms voltage; where there are none, the ones with the most margin.
Design search_gains(const Trials& trials, const SearchSettings& settings);

}  // namespace cartwright::design
