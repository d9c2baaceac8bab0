#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/cli/command.hpp"
#include "host/identify/identify.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

using nlohmann::ordered_json;

struct Options {
  std::string session, out;
  std::string terms = "viscous_friction,coulomb_friction";
  double window_s = WeakFormOptions{}.window_s;
  bool plain = false;
  bool json = false;
};

Result<TermSet> terms_from(const std::string& list) {
  std::vector<Term> terms;
  std::stringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    if (name.empty()) continue;
    const auto term = find_term(name);
    if (!term) {
      std::vector<std::string_view> known;
      for (const TermInfo& entry : cartwright::terms()) known.push_back(entry.name);
      return failure(fmt::format("--terms: {} is no term; known are {}", name, fmt::join(known, ", ")));
    }
    terms.push_back(*term);
  }
  return TermSet::create(terms);
}

ordered_json bound(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

void print_json(const Identification& result) {
  ordered_json document;
  document["parameters"] = ordered_json::object();
  ordered_json at_bound = ordered_json::array();
  for (const ParameterEstimate& found : result.estimates) {
    const std::string name = dotted_name(found.parameter);
    document["parameters"][name] = {{"value", found.estimate.value},
                                    {"low", bound(found.estimate.low)},
                                    {"high", bound(found.estimate.high)}};
    if (found.at_bound) at_bound.push_back(name);
  }
  document["not_separable"] = ordered_json::array();
  for (const Parameter parameter : result.not_separable)
    document["not_separable"].push_back(dotted_name(parameter));
  document["at_bound"] = std::move(at_bound);
  document["windows"] = result.windows;
  document["residual_rms_m_per_s2"] = result.residual_m_per_s2;
  document["acceleration_rms_m_per_s2"] = result.acceleration_m_per_s2;
  fmt::print("{}\n", document.dump(2));
}

void print_table(const Identification& result) {
  for (const ParameterEstimate& found : result.estimates) {
    fmt::print("{:<52} {:>12.6g}", dotted_name(found.parameter), found.estimate.value);
    if (found.estimate.has_interval())
      fmt::print("   [{:.6g}, {:.6g}]", found.estimate.low, found.estimate.high);
    if (found.at_bound) fmt::print("   at its bound");
    fmt::print("\n");
  }
  if (!result.not_separable.empty()) {
    std::vector<std::string> names;
    for (const Parameter parameter : result.not_separable) names.push_back(dotted_name(parameter));
    fmt::print("this data fixes only a combination of: {}\n", fmt::join(names, ", "));
  }
  fmt::print("{} windows, acceleration {:.4g} m/s^2 rms, of which {:.4g} is left\n", result.windows,
             result.acceleration_m_per_s2, result.residual_m_per_s2);
}

Outcome run(const Options& options) {
  const auto terms = terms_from(options.terms);
  if (!terms) return tl::unexpected(terms.error());
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  IdentifyOptions settings;
  settings.weak.window_s = options.window_s;
  settings.instruments = !options.plain;
  const auto result = identify(*session, *terms, settings);
  if (!result) return failure(fmt::format("{}: {}", options.session, result.error().message));
  const auto written = write_model(result->model, options.out);
  if (!written) return tl::unexpected(written.error());
  if (options.json) {
    print_json(*result);
  } else {
    print_table(*result);
  }
  return Status::done;
}

}  // namespace

void add_identify(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("identify", "Fit the named terms to all recordings of a session");
  command->footer(
      "Examples:\n"
      "  cartwright identify --session rig/monday --out model.toml\n"
      "  cartwright identify --session emps --terms viscous_friction,coulomb_friction,constant_force --out "
      "emps.toml");
  auto options = std::make_shared<Options>();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_option("--terms", options->terms, "terms to fit, besides the voltage gain")
      ->capture_default_str();
  command->add_option("--out", options->out, "model file to write (TOML)")->required();
  command->add_option("--window", options->window_s, "length of the test functions [s]")
      ->capture_default_str()
      ->check(CLI::Range(5e-3, 10.0));
  command->add_flag("--plain", options->plain, "least squares without instruments from a simulated twin");
  command->add_flag("--json", options->json, "print one JSON object instead of the table");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
