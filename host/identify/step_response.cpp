#include "host/identify/step_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/identify/motion.hpp"
#include "host/identify/resample.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kBlock_s = 0.05;
constexpr std::size_t kFewestRows = 20;

Result<const Recording*> choose(const Session& session, const std::string& file) {
  for (const Recording& recording : session.recordings) {
    if (!file.empty() && recording.file != file) continue;
    const bool pd = std::holds_alternative<PdGains>(recording.controller);
    const bool steps = !recording.r_m.empty() && (recording.experiment == "step" || !file.empty());
    if (pd && steps) return &recording;
    if (!file.empty()) return failure(fmt::format("{}: a step under a PD controller is needed", file));
  }
  return failure(file.empty() ? "no recording of this session is a step under a PD controller"
                              : fmt::format("no recording of this session is {}", file));
}

IntegralData data_of(const StepResponse& step, StepInput input, std::vector<double>& minus_u_V) {
  if (input == StepInput::error) return {step.t_s, step.e_m, {}};
  minus_u_V.clear();
  for (const double u_V : step.u_V) minus_u_V.push_back(-u_V);
  return {step.t_s, step.y_m, minus_u_V};
}

/// Gain and damping from k and c: Eq. (63) for the error form.
struct Physical {
  double beta = 0;
  std::vector<double> damping_per_s;
};

Physical physical(const VectorXd& unknowns, const StepResponse& step, StepInput input) {
  Physical out;
  const double k = unknowns[unknowns.size() - 1];
  out.beta = input == StepInput::error ? k / step.gains.kp_V_per_m : k;
  const double from_controller = input == StepInput::error ? out.beta * step.gains.kd_V_s_per_m : 0;
  for (Index i = 2; i + 1 < unknowns.size(); ++i) out.damping_per_s.push_back(unknowns[i] - from_controller);
  return out;
}

Result<Model> model_of(const Physical& numbers, const std::vector<double>& speeds_m_per_s) {
  Model model(numbers.beta);
  if (numbers.damping_per_s.size() == 1) {
    return model.set(Parameter::viscous_coefficient, std::max(0.0, numbers.damping_per_s[0]));
  }
  const auto law = fit_damping_law(speeds_m_per_s, numbers.damping_per_s);
  if (!law) return tl::unexpected(law.error());
  return model.set(Parameter::exponential_alpha1, law->alpha1_per_s)
      .set(Parameter::exponential_alpha2, law->alpha2_s_per_m)
      .set(Parameter::exponential_gamma, law->gamma_per_s);
}

Estimate around(double value, const std::vector<double>& draws, std::size_t units) {
  return draws.size() < 2 ? Estimate{value} : Estimate::within(value, half_width_95(draws, units));
}

}  // namespace

Result<StepResponse> find_step(const Session& session, const StepOptions& options) {
  const auto chosen = choose(session, options.file);
  if (!chosen) return tl::unexpected(chosen.error());
  const Recording& recording = **chosen;
  const std::vector<double>& r_m = recording.r_m;
  std::size_t first = 0;
  while (first + 1 < r_m.size() && r_m[first + 1] == r_m.front()) ++first;
  first = first + 1 < r_m.size() ? first + 1 : 0;
  std::size_t last = first;
  while (last < r_m.size() && r_m[last] == r_m[first] &&
         recording.t_s[last] <= recording.t_s[first] + options.duration_s * (1 + 1e-9)) {
    ++last;
  }
  for (const Segment& stretch : segments(recording.t_s)) {
    if (first >= stretch.first && first < stretch.last && last > stretch.last) {
      return failure(fmt::format("{}: rows are missing at t_s = {}; choose a step without a gap",
                                 recording.file, recording.t_s[stretch.last - 1]));
    }
  }
  if (last - first < std::max(kFewestRows, 4 * options.intervals)) {
    return failure(fmt::format("{}: the step lasts {} rows; at least {} are needed", recording.file,
                               last - first, std::max(kFewestRows, 4 * options.intervals)));
  }
  StepResponse step;
  step.file = recording.file;
  step.gains = std::get<PdGains>(recording.controller);
  const std::vector<double> velocity = velocity_of(recording.t_s, recording.y_m).at_m_per_s;
  std::size_t clipped = 0;
  for (std::size_t row = first; row < last; ++row) {
    step.t_s.push_back(recording.t_s[row]);
    step.y_m.push_back(recording.y_m[row]);
    step.e_m.push_back(r_m[row] - recording.y_m[row]);
    step.u_V.push_back(recording.u_V[row]);
    step.speed_m_per_s.push_back(std::abs(velocity[row]));
    if (std::abs(recording.u_V[row]) >= session.rig.voltage_limit_V * (1 - 1e-9)) ++clipped;
  }
  if (options.input == StepInput::error) {
    if (clipped > 0) {
      return failure(
          fmt::format("{}: the command is clipped in {} rows, so that the control error does not suffice; "
                      "take the recorded voltage (--form piecewise --input voltage, or --form recorded)",
                      recording.file, clipped));
    }
    if (!(step.gains.kp_V_per_m > 0)) {
      return failure(fmt::format("{}: the error form needs kp_V_per_m > 0", recording.file));
    }
  }
  return step;
}

Result<StepIdentification> identify_step(const StepResponse& step, const StepOptions& options) {
  std::vector<double> minus_u_V;
  const PiecewiseForm form(data_of(step, options.input, minus_u_V), options.intervals);
  const PiecewiseFit fit = form.fit(options.constraints);
  StepIdentification out;
  out.file = step.file;
  out.kkt = fit.solution.kkt;

  std::vector<double> speeds_m_per_s;
  for (std::size_t i = 0; i < form.intervals(); ++i) {
    const std::size_t first = form.boundaries()[i], last = form.boundaries()[i + 1];
    double sum = 0;
    for (std::size_t row = first; row < last; ++row) sum += step.speed_m_per_s[row];
    speeds_m_per_s.push_back(sum / static_cast<double>(last - first));
  }
  const Physical best = physical(fit.unknowns, step, options.input);
  const auto model = model_of(best, speeds_m_per_s);
  if (!model) return failure(fmt::format("{}: {}", step.file, model.error().message));
  out.model = *model;

  const std::vector<double> fitted_m = form.predict(fit.unknowns);
  const std::vector<double>& measured_m = options.input == StepInput::error ? step.e_m : step.y_m;
  double squares = 0, absolute = 0;
  for (std::size_t row = 0; row < fitted_m.size(); ++row) {
    squares += std::pow(fitted_m[row] - measured_m[row], 2);
    absolute += std::abs(fitted_m[row] - measured_m[row]);
  }
  out.mean_residual_m = absolute / static_cast<double>(fitted_m.size());
  out.residual_m = std::sqrt(squares / static_cast<double>(fitted_m.size()));

  // Wild bootstrap: the residuals of every block keep or change their sign, and the fit is done again.
  const std::vector<VectorXd> gradients = form.block_gradients(fit.unknowns, kBlock_s);
  std::vector<Parameter> names{Parameter::voltage_gain};
  if (form.intervals() == 1) {
    names.push_back(Parameter::viscous_coefficient);
  } else {
    for (const ParameterInfo& parameter : parameters_of(Term::exponential_damping))
      names.push_back(parameter.id);
  }
  std::vector<std::vector<double>> away(names.size()), damping_away(form.intervals());
  for (const VectorXd& shift : random_signs(gradients, options.draws)) {
    const Physical drawn = physical(form.solve(options.constraints, shift).x, step, options.input);
    for (std::size_t i = 0; i < damping_away.size(); ++i) {
      damping_away[i].push_back(drawn.damping_per_s[i] - best.damping_per_s[i]);
    }
    const auto drawn_model = model_of(drawn, speeds_m_per_s);
    if (!drawn_model) continue;  // no law fits this draw: it widens the damping values, not the law
    for (std::size_t i = 0; i < names.size(); ++i)
      away[i].push_back((*drawn_model)[names[i]] - out.model[names[i]]);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    ParameterEstimate found{names[i], around(out.model[names[i]], away[i], gradients.size()), false};
    found.estimate.low = std::max(found.estimate.low, info(names[i]).lower);
    out.estimates.push_back(found);
  }
  for (std::size_t i = 0; i < form.intervals(); ++i) {
    const std::size_t last = std::min(form.boundaries()[i + 1], step.t_s.size() - 1);
    out.damping.push_back({step.t_s[form.boundaries()[i]], step.t_s[last], speeds_m_per_s[i],
                           around(best.damping_per_s[i], damping_away[i], gradients.size())});
  }
  return out;
}

}  // namespace cartwright
