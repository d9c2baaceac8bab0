#include "host/cli/identify_output.hpp"

#include <fmt/format.h>

#include "host/cli/json.hpp"

namespace cartwright::cli {
namespace {

using nlohmann::ordered_json;

/// What every form has in common: `parameters`, `not_separable`, `at_bound`.
ordered_json document_of(const std::vector<ParameterEstimate>& estimates,
                         const std::vector<Parameter>& not_separable) {
  ordered_json document = {{"parameters", ordered_json::object()},
                           {"not_separable", ordered_json::array()},
                           {"at_bound", ordered_json::array()}};
  for (const ParameterEstimate& found : estimates) {
    document["parameters"][dotted_name(found.parameter)] = estimate_json(found.estimate);
    if (found.at_bound) document["at_bound"].push_back(dotted_name(found.parameter));
  }
  for (const Parameter parameter : not_separable) document["not_separable"].push_back(dotted_name(parameter));
  return document;
}

std::string interval_of(const Estimate& estimate) {
  return estimate.has_interval() ? fmt::format("   [{:.6g}, {:.6g}]", estimate.low, estimate.high)
                                 : "   no interval";
}

void print_forces(const std::vector<ForceEstimate>& forces) {
  if (forces.empty()) return;
  fmt::print("\nas forces:\n");
  for (const ForceEstimate& force : forces) {
    fmt::print("{:<52} {:>12.6g}{}\n", force.name, force.estimate.value, interval_of(force.estimate));
  }
  fmt::print("\n");
}

void print_estimates(const std::vector<ParameterEstimate>& estimates) {
  for (const ParameterEstimate& found : estimates) {
    fmt::print("{:<52} {:>12.6g}{}{}\n", dotted_name(found.parameter), found.estimate.value,
               interval_of(found.estimate), found.at_bound ? "   at its bound" : "");
  }
}

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter parameter : parameters) names.push_back(dotted_name(parameter));
  return names;
}

void print_not_separable(const std::vector<Parameter>& parameters) {
  if (parameters.empty()) return;
  fmt::print("this data fixes only a combination of: {}\n", fmt::join(names_of(parameters), ", "));
}

}  // namespace

void print_json(const Identification& result) {
  ordered_json document = document_of(result.estimates, result.not_separable);
  for (const ForceEstimate& force : result.forces) {
    document["forces"][force.name] = estimate_json(force.estimate);
  }
  document["windows"] = result.windows;
  document["residual_rms_m_per_s2"] = number_json(result.residual_m_per_s2);
  document["acceleration_rms_m_per_s2"] = number_json(result.acceleration_m_per_s2);
  fmt::print("{}\n", document.dump(2));
}

void print_json(const StepIdentification& result) {
  ordered_json document = document_of(result.estimates, {});
  document["recording"] = result.file;
  document["damping"] = ordered_json::array();
  for (const DampingInterval& one : result.damping) {
    document["damping"].push_back({{"start_s", one.start_s},
                                   {"end_s", one.end_s},
                                   {"speed_m_per_s", one.speed_m_per_s},
                                   {"damping_per_s", estimate_json(one.damping_per_s)}});
  }
  document["residual_rms_m"] = number_json(result.residual_m);
  document["kkt_residual"] = {{"greatest", number_json(result.kkt.greatest())},
                              {"stationarity", number_json(result.kkt.stationarity)},
                              {"primal", number_json(result.kkt.primal)},
                              {"dual", number_json(result.kkt.dual)},
                              {"complementarity", number_json(result.kkt.complementarity)}};
  fmt::print("{}\n", document.dump(2));
}

void print_json(const SimulationFit& result) {
  ordered_json document = document_of(result.estimates, result.not_separable);
  document["held"] = names_of(result.held);
  document["rows"] = result.rows;
  document["open_loop_rmse_m"] = {{"before", number_json(result.before_m)},
                                  {"after", number_json(result.after_m)}};
  document["open_loop_rmse_m"]["held_out"] =
      result.held_out_m ? number_json(*result.held_out_m) : ordered_json();
  fmt::print("{}\n", document.dump(2));
}

void print_table(const Identification& result) {
  print_estimates(result.estimates);
  print_forces(result.forces);
  print_not_separable(result.not_separable);
  fmt::print("{} windows, acceleration {:.4g} m/s^2 rms, of which {:.4g} is left\n", result.windows,
             result.acceleration_m_per_s2, result.residual_m_per_s2);
}

void print_table(const StepIdentification& result) {
  print_estimates(result.estimates);
  if (result.damping.size() > 1) {
    fmt::print("\n{:>8} {:>8} {:>17} {:>14}\n", "from [s]", "to [s]", "mean speed [m/s]", "damping [1/s]");
    for (const DampingInterval& one : result.damping) {
      fmt::print("{:>8.3f} {:>8.3f} {:>17.4f} {:>14.6g}{}\n", one.start_s, one.end_s, one.speed_m_per_s,
                 one.damping_per_s.value, interval_of(one.damping_per_s));
    }
    fmt::print("damping against speed: alpha1 exp(-alpha2 |v|) + gamma, as above\n\n");
  }
  fmt::print("{}: {:.4g} mm rms is left; KKT residual {:.2g}\n", result.file, 1e3 * result.residual_m,
             result.kkt.greatest());
}

void print_table(const SimulationFit& result) {
  print_estimates(result.estimates);
  print_not_separable(result.not_separable);
  if (!result.held.empty()) fmt::print("kept as given: {}\n", fmt::join(names_of(result.held), ", "));
  fmt::print("whole recordings, simulated from their voltage: {:.4g} mm rms off before, {:.4g} mm now\n",
             1e3 * result.before_m, 1e3 * result.after_m);
  if (result.held_out_m)
    fmt::print("second halves, by a fit to first halves: {:.4g} mm\n", 1e3 * *result.held_out_m);
}

}  // namespace cartwright::cli
