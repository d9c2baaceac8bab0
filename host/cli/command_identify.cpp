#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

#include "host/cli/command.hpp"
#include "host/cli/gap_note.hpp"
#include "host/cli/identify_output.hpp"
#include "host/cli/progress.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string session, out;
  std::string form = "recorded";
  bool json = false;
  // The recorded form.
  std::string terms = "viscous_friction,coulomb_friction";
  double window_s = WeakFormOptions{}.window_s;
  bool plain = false;
  ForceScale force_scale;
  // The form that simulates.
  std::string model;
  std::vector<std::string> hold;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  // The forms of one step response.
  std::string recording, input = "error";
  double duration_s = StepOptions{}.duration_s;
  std::size_t intervals = 6;
  std::optional<double> monotone_per_s, slope_per_s2;
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

/// A number; CLI11 takes "nan" and "inf" for numbers too.
const CLI::Validator kFinite(
    [](const std::string& text) {
      double value = 0;
      const bool fine = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return fine ? std::string() : text + " is not a finite number";
    },
    "");

/// An option that the chosen form would pass over in silence is refused.
Result<void> check_belongs(const CLI::App& command, const std::string& form) {
  struct Belongs {
    const char* option;
    const char* forms;
  };
  constexpr Belongs kBelongs[] = {
      {"--terms", "recorded"},
      {"--window", "recorded"},
      {"--plain", "recorded"},
      {"--drive", "recorded"},
      {"--mass", "recorded"},
      {"--model", "simulation"},
      {"--hold", "simulation"},
      {"--threads", "simulation"},
      {"--input", "piecewise"},
      {"--intervals", "piecewise"},
      {"--monotone", "piecewise"},
      {"--slope", "piecewise"},
      {"--duration", "error piecewise"},
      {"--recording", "error piecewise"},
  };
  for (const Belongs& one : kBelongs) {
    if (command.count(one.option) == 0 || std::string_view(one.forms).find(form) != std::string_view::npos)
      continue;
    std::string forms = one.forms;
    if (const auto space = forms.find(' '); space != std::string::npos) forms.replace(space, 1, " or ");
    return failure(fmt::format("{} belongs to --form {}, not to --form {}", one.option, forms, form));
  }
  return {};
}

template <typename Found>
Outcome finish(const Options& options, const Result<Found>& found) {
  if (!found) return failure(fmt::format("{}: {}", options.session, found.error().message));
  std::vector<ParameterInterval> intervals;
  for (const ParameterEstimate& one : found->estimates)
    intervals.push_back({one.parameter, one.estimate.low, one.estimate.high});
  const auto written = write_model(found->model, options.out, intervals);
  if (!written) return tl::unexpected(written.error());
  options.json ? print_json(*found) : print_table(*found);
  return Status::done;
}

Outcome run_recorded(const Options& options, const Session& session) {
  const auto terms = terms_from(options.terms);
  if (!terms) return tl::unexpected(terms.error());
  IdentifyOptions settings;
  settings.weak.window_s = options.window_s;
  settings.instruments = !options.plain;
  if (options.force_scale.drive_N_per_V || options.force_scale.mass_kg)
    settings.force_scale = options.force_scale;
  const auto found = [&] {
    ProgressBar bar("searching");
    settings.progress = [&bar](double part) { bar.show(part); };
    return identify(session, *terms, settings);
  }();
  return finish(options, found);
}

Outcome run_simulation(const Options& options, const Session& session) {
  if (options.model.empty())
    return failure("--form simulation refits a model: --model FILE, with numbers to start from, is missing");
  const auto model = read_model(options.model);
  if (!model) return tl::unexpected(model.error());
  SimulationFitOptions settings;
  settings.threads = options.threads;
  for (const std::string& name : options.hold) {
    const auto id = find_parameter(name);
    if (!id || (info(*id).term && !model->has(*info(*id).term)))
      return failure(fmt::format("--hold {}: {} holds no such number; names are as in identify's answer",
                                 name, options.model));
    settings.held.push_back(*id);
  }
  const auto found = [&] {
    ProgressBar bar("simulating");
    settings.progress = [&bar](double part) { bar.show(part); };
    return fit_by_simulation(session, *model, settings);
  }();
  return finish(options, found);
}

Outcome run_step(const Options& options, const Session& session) {
  StepOptions settings;
  settings.file = options.recording;
  settings.duration_s = options.duration_s;
  if (options.form == "piecewise") {
    settings.intervals = options.intervals;
    settings.input = options.input == "voltage" ? StepInput::voltage : StepInput::error;
    settings.constraints.least_rise_per_s = options.monotone_per_s;
    settings.constraints.greatest_slope_per_s2 = options.slope_per_s2;
  }
  const auto step = find_step(session, settings);
  if (!step) return failure(fmt::format("{}: {}", options.session, step.error().message));
  return finish(options, identify_step(*step, settings));
}

Outcome run(const Options& options, const CLI::App& command) {
  if (const auto fits = check_belongs(command, options.form); !fits) return tl::unexpected(fits.error());
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  tell_gaps(*session);
  if (options.form == "recorded") return run_recorded(options, *session);
  return options.form == "simulation" ? run_simulation(options, *session) : run_step(options, *session);
}

}  // namespace

void add_identify(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("identify", "Find the numbers of a model in recordings");
  command->footer(
      "Forms:\n"
      "  recorded   the named terms, from the recorded voltage of all recordings at once\n"
      "  simulation the numbers of a model, by simulating whole recordings from their voltage\n"
      "  error      gain and constant damping, from the control error of one step (Eq. 51-53)\n"
      "  piecewise  gain, damping over equal intervals of one step, and its law of speed (Eq. 13-29, 67-71)\n"
      "Examples:\n"
      "  cartwright identify --session rig/monday --out model.toml\n"
      "  cartwright identify --session rig/monday --terms viscous_friction,cogging --out model.toml\n"
      "  cartwright identify --session emps --drive 35.15065 --out emps-model.toml\n"
      "  cartwright identify --session rig/monday --form simulation --model model.toml --out refitted.toml\n"
      "  cartwright identify --session rig/monday --form piecewise --recording step_kp60_1.csv --out "
      "nl.toml\n"
      "  cartwright identify --session rig/monday --form piecewise --intervals 30 --slope 60 --out nl.toml");
  auto options = std::make_shared<Options>();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_option("--out", options->out, "model file to write (TOML)")->required();
  command->add_option("--form", options->form, "recorded, simulation, error or piecewise")
      ->capture_default_str()
      ->check(CLI::IsMember({"recorded", "simulation", "error", "piecewise"}));
  command->add_flag("--json", options->json, "print one JSON object instead of the table");
  command->add_option("--terms", options->terms, "recorded: terms to fit, besides the voltage gain")
      ->capture_default_str();
  command->add_option("--window", options->window_s, "recorded: length of the test functions [s]")
      ->capture_default_str()
      ->check(CLI::Range(5e-3, 10.0));
  command->add_flag("--plain", options->plain,
                    "recorded: least squares without instruments from a simulated twin");
  CLI::Option* drive =
      command
          ->add_option("--drive", options->force_scale.drive_N_per_V,
                       "recorded: force of the drive per volt [N/V]; prints mass and forces too")
          ->check(kFinite)
          ->check(CLI::PositiveNumber);
  command
      ->add_option("--mass", options->force_scale.mass_kg,
                   "recorded: moving mass [kg]; prints the drive's force per volt and forces too")
      ->check(kFinite)
      ->check(CLI::PositiveNumber)
      ->excludes(drive);
  command->add_option("--model", options->model,
                      "simulation: model file whose terms are kept and numbers refitted");
  command
      ->add_option("--hold", options->hold,
                   "simulation: numbers to keep as given: voltage_gain_m_per_s2_V, ...")
      ->delimiter(',');
  command->add_option("--threads", options->threads, "simulation: threads to use")
      ->check(CLI::Range(1u, 256u))
      ->capture_default_str();
  command->add_option("--recording", options->recording,
                      "error, piecewise: file of the step; the first PD step where absent");
  command->add_option("--duration", options->duration_s, "error, piecewise: time used, from the step on [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.02, 60.0));
  command
      ->add_option("--input", options->input,
                   "piecewise: integrate the control error, or the recorded voltage (error, voltage)")
      ->capture_default_str()
      ->check(CLI::IsMember({"error", "voltage"}));
  command->add_option("--intervals", options->intervals, "piecewise: number of intervals")
      ->capture_default_str()
      ->check(CLI::Range(1, 400));
  command
      ->add_option("--monotone", options->monotone_per_s,
                   "piecewise: damping rises by at least this much from interval to interval [1/s]")
      ->check(kFinite);
  command
      ->add_option("--slope", options->slope_per_s2,
                   "piecewise: damping changes by at most this much in time [1/s^2]")
      ->check(kFinite)
      ->check(CLI::NonNegativeNumber);
  on_run(command, exit_status, [options, command] { return run(*options, *command); });
}

}  // namespace cartwright::cli
