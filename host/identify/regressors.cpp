#include "host/identify/regressors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cartwright {
namespace {

struct TermColumns {
  Term term;
  std::vector<Feature> features;
  std::vector<Parameter> shapes;
};

const std::vector<TermColumns>& term_columns() {
  using F = Feature;
  using P = Parameter;
  static const std::vector<TermColumns> table{
      {Term::viscous_friction, {F::velocity}, {}},
      {Term::coulomb_friction, {F::direction}, {}},
      {Term::exponential_damping, {F::exponential, F::velocity}, {P::exponential_alpha2}},
      {Term::stribeck_friction, {F::stribeck}, {P::stribeck_speed}},
      {Term::constant_force, {F::one}, {}},
      {Term::asymmetric_viscous_friction, {F::speed}, {}},
      {Term::position_dependent_friction, {F::spot}, {P::spot_centre, P::spot_width}},
      {Term::cogging, {F::cogging_sine, F::cogging_cosine}, {P::cogging_period}},
      {Term::input_dead_zone, {}, {P::dead_zone_half_width}},
      {Term::voltage_saturation, {}, {P::saturation_limit}},
      {Term::armature_lag, {}, {P::armature_time_constant}},
      {Term::transport_delay, {}, {P::transport_delay}},
      {Term::cable_spring, {F::position, F::one}, {}},
      {Term::quadratic_drag, {F::drag}, {}},
      {Term::motor_heating, {F::warm_voltage}, {P::heating_time_constant}},
      {Term::amplifier_gain_asymmetry, {F::absolute_voltage}, {}},
  };
  return table;
}

/// One wave of the cogging is fitted; the diagnosis finds further ones.
bool is_further_wave(Parameter parameter) {
  return std::any_of(kCoggingWaves.begin() + 1, kCoggingWaves.end(),
                     [&](const PeriodicTerm& wave) { return wave.has(parameter); });
}

double shape_of(const Model& shape, Term term, Parameter parameter, double absent) {
  return shape.has(term) ? shape[parameter] : absent;
}

/// Mean of the delayed, lagged voltage over every interval; `chain` maps the command first.
template <typename Map>
std::vector<double> driving_voltage(const Recording& recording, const std::vector<double>& u_V,
                                    const Model& shape, Map&& chain) {
  const std::vector<double>& t = recording.t_s;
  const std::size_t intervals = t.size() - 1;
  std::vector<double> mean_V(intervals);
  for (std::size_t k = 0; k < intervals; ++k) mean_V[k] = chain(u_V[k]);
  const double delay_s = shape_of(shape, Term::transport_delay, Parameter::transport_delay, 0);
  if (delay_s > 0) {
    std::vector<double> integral_V_s(t.size(), 0.0);
    for (std::size_t k = 0; k < intervals; ++k)
      integral_V_s[k + 1] = integral_V_s[k] + mean_V[k] * (t[k + 1] - t[k]);
    std::size_t at = 0;
    double before = 0;
    for (std::size_t row = 0; row < t.size(); ++row) {
      const double source_s = t[row] - delay_s;
      while (at + 1 < t.size() && t[at + 1] <= source_s) ++at;
      const double now = source_s <= t[0] ? 0.0 : integral_V_s[at] + chain(u_V[at]) * (source_s - t[at]);
      if (row > 0) mean_V[row - 1] = (now - before) / (t[row] - t[row - 1]);
      before = now;
    }
  }
  const double lag_s = shape_of(shape, Term::armature_lag, Parameter::armature_time_constant, 0);
  if (lag_s > 0) {
    double state_V = mean_V[0];
    for (std::size_t k = 0; k < intervals; ++k) {
      const double h = t[k + 1] - t[k], target_V = mean_V[k], left = std::exp(-h / lag_s);
      mean_V[k] = target_V + (state_V - target_V) * (1 - left) * lag_s / h;
      state_V = target_V + (state_V - target_V) * left;
    }
  }
  return mean_V;
}

}  // namespace

Result<TermSet> TermSet::create(const std::vector<Term>& terms) {
  TermSet set;
  set.features_.push_back(Feature::voltage);
  for (const Term term : terms) {
    if (set.has(term)) continue;
    const auto found = std::find_if(term_columns().begin(), term_columns().end(),
                                    [term](const TermColumns& entry) { return entry.term == term; });
    if (found == term_columns().end()) {
      std::vector<std::string_view> names;
      for (const TermColumns& entry : term_columns()) names.push_back(info(entry.term).name);
      return failure(fmt::format("{} cannot be fitted by the integral method; it fits {}", info(term).name,
                                 fmt::join(names, ", ")));
    }
    set.terms_.push_back(term);
    for (const Feature feature : found->features) {
      if (std::find(set.features_.begin(), set.features_.end(), feature) == set.features_.end()) {
        set.features_.push_back(feature);
      }
    }
    set.shapes_.insert(set.shapes_.end(), found->shapes.begin(), found->shapes.end());
  }
  const auto needs = [&](Term term, Term base) { return set.has(term) && !set.has(base); };
  if (needs(Term::asymmetric_viscous_friction, Term::viscous_friction)) {
    return failure("asymmetric_viscous_friction is a difference of viscous_friction: name that term too");
  }
  set.parameters_.push_back(Parameter::voltage_gain);
  for (const ParameterInfo& parameter : cartwright::parameters()) {
    if (parameter.term && set.has(*parameter.term) && !is_further_wave(parameter.id))
      set.parameters_.push_back(parameter.id);
  }
  return set;
}

bool TermSet::has(Term term) const {
  return std::find(terms_.begin(), terms_.end(), term) != terms_.end();
}

bool TermSet::nonnegative(Feature feature) const {
  switch (feature) {
    case Feature::velocity:
    case Feature::direction:
    case Feature::drag:
    case Feature::exponential:
    case Feature::stribeck:
    case Feature::spot:
      return true;
    default:
      return false;
  }
}

Model TermSet::to_model(const Eigen::VectorXd& theta, const Model& shape) const {
  const auto of = [&](Feature feature) {
    const auto found = std::find(features_.begin(), features_.end(), feature);
    return found == features_.end() ? 0.0 : theta[found - features_.begin()];
  };
  const double beta = of(Feature::voltage);
  Model model(beta);
  for (const Parameter parameter : shapes_) model.set(parameter, shape[parameter]);
  const bool viscous = has(Term::viscous_friction);
  for (const Term term : terms_) {
    switch (term) {
      case Term::viscous_friction:
        model.set(Parameter::viscous_coefficient, of(Feature::velocity));
        break;
      case Term::coulomb_friction:
        model.set(Parameter::coulomb_level, of(Feature::direction));
        break;
      case Term::exponential_damping:
        model.set(Parameter::exponential_alpha1, of(Feature::exponential));
        model.set(Parameter::exponential_gamma, viscous ? 0.0 : of(Feature::velocity));
        break;
      case Term::stribeck_friction:
        model.set(Parameter::stribeck_excess, of(Feature::stribeck));
        break;
      case Term::constant_force:
        model.set(Parameter::constant_acceleration, of(Feature::one));
        break;
      case Term::asymmetric_viscous_friction:
        model.set(Parameter::asymmetric_viscous_difference, of(Feature::speed) / of(Feature::velocity));
        break;
      case Term::position_dependent_friction:
        model.set(Parameter::spot_peak, of(Feature::spot));
        break;
      case Term::cogging:
        model.set(Parameter::cogging_amplitude,
                  std::hypot(of(Feature::cogging_sine), of(Feature::cogging_cosine)));
        model.set(Parameter::cogging_phase,
                  std::atan2(of(Feature::cogging_cosine), of(Feature::cogging_sine)));
        break;
      case Term::cable_spring:
        model.set(Parameter::spring_stiffness, of(Feature::position));
        // With a constant force in the model the spring's neutral point and that force are one number.
        model.set(Parameter::spring_neutral,
                  has(Term::constant_force) ? 0.0 : of(Feature::one) / of(Feature::position));
        break;
      case Term::quadratic_drag:
        model.set(Parameter::drag_coefficient, of(Feature::drag));
        break;
      case Term::motor_heating:
        model.set(Parameter::heating_gain_loss, of(Feature::warm_voltage) / beta);
        break;
      case Term::amplifier_gain_asymmetry:
        model.set(Parameter::amplifier_gain_difference, of(Feature::absolute_voltage) / beta);
        break;
      default:
        break;  // terms that are shapes alone
    }
  }
  return model;
}

std::vector<std::size_t> TermSet::columns_of(Parameter parameter) const {
  std::vector<Feature> wanted;
  const auto& term = info(parameter).term;
  if (!term) {
    wanted = {Feature::voltage};
  } else if (std::find(shapes_.begin(), shapes_.end(), parameter) == shapes_.end()) {
    const auto found = std::find_if(term_columns().begin(), term_columns().end(),
                                    [&](const TermColumns& entry) { return entry.term == *term; });
    wanted = found->features;
    if (parameter == Parameter::spring_stiffness) wanted = {Feature::position};
    if (parameter == Parameter::spring_neutral) wanted = {Feature::one};
    if (parameter == Parameter::exponential_alpha1) wanted = {Feature::exponential};
    if (parameter == Parameter::exponential_gamma) wanted = {Feature::velocity};
  }
  std::vector<std::size_t> out;
  for (std::size_t column = 0; column < features_.size(); ++column) {
    if (std::find(wanted.begin(), wanted.end(), features_[column]) != wanted.end()) out.push_back(column);
  }
  return out;
}

Eigen::MatrixXd interval_means(const TermSet& terms, const Model& shape, const Recording& recording,
                               const std::vector<double>& y_m, const Velocity& velocity,
                               const std::vector<double>& u_V) {
  const std::vector<double>& t = recording.t_s;
  const auto intervals = static_cast<Eigen::Index>(t.size()) - 1;
  const double zone_V = shape_of(shape, Term::input_dead_zone, Parameter::dead_zone_half_width, 0);
  const double limit_V = shape_of(shape, Term::voltage_saturation, Parameter::saturation_limit, 1e300);
  const auto map = [zone_V, limit_V](double u) {
    if (zone_V > 0) u = std::abs(u) <= zone_V ? 0.0 : u - std::copysign(zone_V, u);
    return std::clamp(u, -limit_V, limit_V);
  };
  const std::vector<double> drive_V = driving_voltage(recording, u_V, shape, map);
  std::vector<double> drive_magnitude_V;
  if (terms.has(Term::amplifier_gain_asymmetry)) {
    drive_magnitude_V = driving_voltage(recording, u_V, shape, [&](double u) { return std::abs(map(u)); });
  }
  const double alpha2 = shape[Parameter::exponential_alpha2];
  const double stribeck = 1 / shape_of(shape, Term::stribeck_friction, Parameter::stribeck_speed, 1);
  const double centre = shape[Parameter::spot_centre];
  const double inverse_width =
      1 / shape_of(shape, Term::position_dependent_friction, Parameter::spot_width, 1);
  const double wavenumber =
      2 * std::numbers::pi / shape_of(shape, Term::cogging, Parameter::cogging_period, 1);
  const double warm_rate = 1 / shape_of(shape, Term::motor_heating, Parameter::heating_time_constant, 1);

  Eigen::MatrixXd out(intervals, static_cast<Eigen::Index>(terms.features().size()));
  for (Eigen::Index k = 0; k < intervals; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const double h = t[row + 1] - t[row];
    const double y = 0.5 * (y_m[row] + y_m[row + 1]);
    const double v0 = velocity.at_m_per_s[row], v1 = velocity.at_m_per_s[row + 1], v = 0.5 * (v0 + v1);
    const double slope = (y_m[row + 1] - y_m[row]) / h;
    const double sign = velocity.direction[row];
    Eigen::Index column = 0;
    for (const Feature feature : terms.features()) {
      double& value = out(k, column++);
      switch (feature) {
        case Feature::voltage:
          value = drive_V[row];
          break;
        case Feature::velocity:
          value = -slope;
          break;
        case Feature::direction:
          value = -sign;
          break;
        case Feature::one:
          value = 1;
          break;
        case Feature::position:
          value = -y;
          break;
        case Feature::speed:
          value = -0.25 * (std::abs(v0) + std::abs(v1));
          break;
        case Feature::drag:
          value = -0.5 * (v0 * std::abs(v0) + v1 * std::abs(v1));
          break;
        case Feature::exponential:
          value = -std::exp(-alpha2 * std::abs(v)) * slope;
          break;
        case Feature::stribeck:
          value = -sign * std::exp(-(v * stribeck) * (v * stribeck));
          break;
        case Feature::spot: {
          const double x = (y - centre) * inverse_width;
          value = -sign * std::exp(-0.5 * x * x);
          break;
        }
        case Feature::cogging_sine:
          value = std::sin(wavenumber * y);
          break;
        case Feature::cogging_cosine:
          value = std::cos(wavenumber * y);
          break;
        case Feature::absolute_voltage:
          value = 0.5 * drive_magnitude_V[row];
          break;
        case Feature::warm_voltage:
          value = -drive_V[row] * (1 - std::exp(-(t[row] + 0.5 * h - t[0]) * warm_rate));
          break;
      }
    }
    out.row(k) *= velocity.moving_share[row];
  }
  return out;
}

}  // namespace cartwright
