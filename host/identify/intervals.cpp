#include "host/identify/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/identify/resample.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBlock_s = 1.0;
constexpr std::size_t kFewestRecordings = 6;
constexpr std::size_t kFewestUnits = 4;
constexpr double kWiderWindow = 1.5;

void add_shape_columns(const Problem& problem, const TermSet& terms, Solution& solution) {
  for (const Parameter shape : terms.shapes()) {
    const double value = solution.model[shape];
    const double trial = std::max(1e-4 * std::abs(value), 1e-7);
    Model moved = solution.model;
    moved.set(shape, value + trial);
    const std::vector<MatrixXd> shifted = problem.all_columns(moved);
    const auto size = static_cast<Index>(terms.features().size());
    for (std::size_t i = 0; i < shifted.size(); ++i) {
      const VectorXd change = (shifted[i] - solution.jacobian[i].leftCols(size)) * solution.theta / trial;
      for (MatrixXd* matrix : {&solution.jacobian[i], &solution.instruments[i]}) {
        matrix->conservativeResize(Eigen::NoChange, matrix->cols() + 1);
        matrix->rightCols(1) = change;
      }
    }
  }
}

ResampleUnit unit_of(const Solution& solution, std::size_t recording, Index first, Index count) {
  const auto Z = solution.instruments[recording].middleRows(first, count);
  const auto J = solution.jacobian[recording].middleRows(first, count);
  return {Z.transpose() * J, Z.transpose() * solution.residual[recording].segment(first, count)};
}

/// Blocks of neighbouring windows; windows overlap, blocks of a second and more hardly do.
std::vector<ResampleUnit> blocks(const Problem& problem, const Solution& solution, double block_s) {
  std::vector<ResampleUnit> out;
  for (std::size_t i = 0; i < problem.prepared().size(); ++i) {
    const std::vector<Window>& windows = problem.prepared()[i].windows;
    std::size_t first = 0;
    for (std::size_t at = 0; at <= windows.size(); ++at) {
      const bool ends = at == windows.size();
      if (at > first && (ends || windows[at].bump.centre_s - windows[first].bump.centre_s >= block_s)) {
        out.push_back(unit_of(solution, i, static_cast<Index>(first), static_cast<Index>(at - first)));
        first = at;
      }
    }
  }
  return out;
}

std::vector<ResampleUnit> whole_recordings(const Problem& problem, const Solution& solution) {
  std::vector<ResampleUnit> out;
  for (std::size_t i = 0; i < problem.prepared().size(); ++i) {
    const auto count = static_cast<Index>(problem.prepared()[i].windows.size());
    if (count > 0) out.push_back(unit_of(solution, i, 0, count));
  }
  return out;
}

/// The model at the estimate moved by delta.
Model moved_model(const TermSet& terms, const Solution& solution, const VectorXd& delta) {
  const auto size = static_cast<Index>(terms.features().size());
  Model shape = solution.model;
  for (std::size_t i = 0; i < terms.shapes().size(); ++i) {
    shape.set(terms.shapes()[i], solution.model[terms.shapes()[i]] + delta[size + static_cast<Index>(i)]);
  }
  return terms.to_model(solution.theta + delta.head(size), shape);
}

/// A number that a model gives, and that wants an interval.
struct Quantity {
  Parameter parameter;
  std::optional<ForceScale> scale;  ///< none: the parameter itself

  double of(const Model& model) const {
    return scale ? force_value(parameter, *scale, model) : model[parameter];
  }
  double away(const Model& there, const Model& here) const {
    const double difference = of(there) - of(here);
    if (parameter == Parameter::cogging_phase) return std::remainder(difference, 2 * std::numbers::pi);
    return difference;
  }
};

/// Half widths of the intervals of all quantities, from one way of forming units.
VectorXd half_widths(const std::vector<Quantity>& quantities, const TermSet& terms, const Solution& solution,
                     const std::vector<ResampleUnit>& units, int draws) {
  const MatrixXd deltas = resample(units, draws);
  std::vector<std::vector<double>> values(quantities.size());
  for (Index draw = 0; draw < deltas.rows(); ++draw) {
    const Model model = moved_model(terms, solution, deltas.row(draw).transpose());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i].push_back(quantities[i].away(model, solution.model));
  }
  VectorXd out(static_cast<Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    out[static_cast<Index>(i)] = half_width_95(values[i], units.size());
  return out;
}

/// By how much the quantities move with windows half as long again, the shapes held.
VectorXd window_shift(const std::vector<Quantity>& quantities, const Problem& problem, const TermSet& terms,
                      const Linear& linear, const Solution& solution, const IdentifyOptions& options) {
  const Problem wider = problem.with_window(kWiderWindow * options.weak.window_s);
  VectorXd out = VectorXd::Zero(static_cast<Index>(quantities.size()));
  if (wider.windows() < 2 * terms.features().size()) return out;
  const Linear other = wider.least_squares(wider.all_columns(solution.model));
  const Model here = terms.to_model(linear.theta, solution.model);
  const Model there = terms.to_model(other.theta, solution.model);
  for (Index i = 0; i < out.size(); ++i) {
    const double away = quantities[static_cast<std::size_t>(i)].away(there, here);
    if (std::isfinite(away)) out[i] = away;
  }
  return out;
}

/// A column with a notable part in a near-null direction.
bool in_null_space(const Linear& linear, Index column) {
  constexpr double kNotable = 0.1;
  return linear.null_directions.cols() > 0 &&
         linear.null_directions.row(column).cwiseAbs().maxCoeff() > kNotable;
}

/// The number without which another means nothing: where a spring may have no stiffness, its neutral position
/// is anything.
std::optional<Parameter> size_behind(Parameter parameter) {
  switch (parameter) {
    case Parameter::exponential_alpha2:
      return Parameter::exponential_alpha1;
    case Parameter::stribeck_speed:
      return Parameter::stribeck_excess;
    case Parameter::spot_centre:
    case Parameter::spot_width:
      return Parameter::spot_peak;
    case Parameter::cogging_period:
    case Parameter::cogging_phase:
      return Parameter::cogging_amplitude;
    case Parameter::spring_neutral:
      return Parameter::spring_stiffness;
    case Parameter::heating_time_constant:
      return Parameter::heating_gain_loss;
    default:
      return {};
  }
}

/// Takes the intervals from numbers whose size may be zero.
void open_what_means_nothing(std::vector<ParameterEstimate>& estimates) {
  for (ParameterEstimate& one : estimates) {
    const auto size = size_behind(one.parameter);
    if (!size) continue;
    const auto found = std::find_if(estimates.begin(), estimates.end(),
                                    [&](const ParameterEstimate& other) { return other.parameter == *size; });
    if (found == estimates.end()) continue;
    const Estimate& behind = found->estimate;
    if (!behind.has_interval() || (behind.low <= 0 && behind.high >= 0)) one.estimate = {one.estimate.value};
  }
}

bool fixed_by_other(const TermSet& terms, Parameter parameter) {
  if (parameter == Parameter::spring_neutral) return terms.has(Term::constant_force);
  if (parameter == Parameter::constant_acceleration) return terms.has(Term::cable_spring);
  if (parameter == Parameter::viscous_coefficient) return terms.has(Term::exponential_damping);
  if (parameter == Parameter::exponential_gamma) return terms.has(Term::viscous_friction);
  return false;
}

}  // namespace

void add_estimates(const Problem& problem, const TermSet& terms, const Linear& linear, Solution solution,
                   const IdentifyOptions& options, Identification& out) {
  add_shape_columns(problem, terms, solution);
  const double moving_s = static_cast<double>(problem.windows()) * options.weak.hop * options.weak.window_s;
  const double block_s = std::max(2 * options.weak.window_s, std::min(kBlock_s, moving_s / 12));
  std::vector<ResampleUnit> units = blocks(problem, solution, block_s);
  out.units = units.size();
  std::vector<Quantity> quantities;
  for (const Parameter parameter : terms.parameters()) quantities.push_back({parameter, {}});
  for (const Parameter parameter : terms.parameters()) {
    if (options.force_scale && force_name(parameter, *options.force_scale))
      quantities.push_back({parameter, options.force_scale});
  }
  VectorXd widths;
  if (units.size() >= kFewestUnits) {
    widths = half_widths(quantities, terms, solution, units, options.draws);
    units = whole_recordings(problem, solution);
    if (units.size() >= kFewestRecordings) {
      widths = widths.cwiseMax(half_widths(quantities, terms, solution, units, options.draws));
    }
  }
  if (widths.size() > 0) {
    const VectorXd shift = window_shift(quantities, problem, terms, linear, solution, options);
    for (Index i = 0; i < widths.size(); ++i) {
      widths[i] = std::hypot(widths[i], shift[i]);
      // Nothing in the data moves with this number (a limit that is never reached).
      if (widths[i] == 0) widths[i] = std::nan("");
    }
  }
  for (std::size_t i = 0; i < terms.parameters().size(); ++i) {
    ParameterEstimate found;
    found.parameter = terms.parameters()[i];
    found.estimate.value = solution.model[found.parameter];
    bool separable = !fixed_by_other(terms, found.parameter);
    for (const std::size_t column : terms.columns_of(found.parameter)) {
      if (in_null_space(linear, static_cast<Index>(column))) separable = false;
      found.at_bound = found.at_bound || linear.at_bound[column];
    }
    const ParameterInfo& known = info(found.parameter);
    if (!separable) out.not_separable.push_back(found.parameter);
    const double width = widths.size() > 0 ? widths[static_cast<Index>(i)] : std::nan("");
    if (separable && std::isfinite(width)) {
      found.estimate.low = std::max(known.lower, found.estimate.value - width);
      found.estimate.high = std::min(known.upper, found.estimate.value + width);
    }
    out.estimates.push_back(found);
  }
  open_what_means_nothing(out.estimates);
  for (std::size_t i = terms.parameters().size(); i < quantities.size(); ++i) {
    const Quantity& force = quantities[i];
    const double value = force.of(solution.model);
    const double width = widths.size() > 0 ? widths[static_cast<Index>(i)] : std::nan("");
    const bool bounded = std::isfinite(width) && std::find(out.not_separable.begin(), out.not_separable.end(),
                                                           force.parameter) == out.not_separable.end();
    out.forces.push_back({*force_name(force.parameter, *force.scale),
                          bounded ? Estimate::within(value, width) : Estimate{value}});
  }
}

}  // namespace cartwright
