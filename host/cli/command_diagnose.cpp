#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "host/cli/command.hpp"
#include "host/cli/progress.hpp"
#include "host/diagnose/diagnosis.hpp"
#include "host/diagnose/judge/hygiene.hpp"
#include "host/diagnose/judge/statement.hpp"
#include "host/diagnose/show/diagnosis_json.hpp"
#include "host/diagnose/show/diagnosis_page.hpp"
#include "host/session/files.hpp"

namespace cartwright::cli {
namespace {

struct Options {
  std::string model, session, out;
  std::vector<std::string> hold;
  unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  bool json = false;
};

void print_summary(const Diagnosis& d, const std::string& out) {
  fmt::print("{}\n", name(d.verdict));
  for (const Effect& effect : d.effects) {
    fmt::print("  {} (confidence {:.2f}): {}\n", info(effect.term).name, effect.confidence, effect.statement);
    for (const auto& [id, e] : effect.parameters) {
      fmt::print("      {} = {:.5g} [{:.5g}, {:.5g}]\n", info(id).key, e.value, e.low, e.high);
    }
    if (!effect.support.recordings.empty())
      fmt::print("      {}\n", statement_of_support(effect.support, d.noise_floor_m));
    if (!effect.equivalent.empty()) fmt::print("      also possible: {}\n", names_of(effect.equivalent));
  }
  for (const NominalParameter& p : d.parameters) {
    const Estimate& e = p.refitted;
    fmt::print("  {}: nominal {:.5g}, found {:.5g} {}\n", dotted_name(p.id), p.nominal, e.value,
               e.has_interval() ? fmt::format("[{:.5g}, {:.5g}]", e.low, e.high) : "(not told by this data)");
  }
  fmt::print("  {}\n", statement_of_windows(d));
  if (d.unexplained) {
    fmt::print("  {}\n", statement_of_left_over(*d.unexplained));
    const std::string periods = statement_of_periods(d.unexplained->periods_m);
    if (!periods.empty()) fmt::print("  {}\n", periods);
    if (!d.unexplained->why_refused.empty()) fmt::print("  {}\n", d.unexplained->why_refused);
  }
  for (const std::string& remark : d.remarks) fmt::print("  {}\n", remark);
  if (d.next_experiment)
    fmt::print("  next: cartwright device run {}\n        {}\n", d.next_experiment->experiment,
               statement_of_next(*d.next_experiment, d.unexplained.has_value()));
  fmt::print("  written: {0}/diagnosis.json, {0}/model.toml, {0}/report.html{1}\n", out,
             d.unexplained ? fmt::format(", {}/missing_force.csv", out) : "");
}

Outcome run(const Options& options) {
  const auto model = read_model(options.model);
  if (!model) return tl::unexpected(model.error());
  const auto session = read_session(options.session);
  if (!session) return tl::unexpected(session.error());
  auto remarks = check_hygiene(*session);
  if (!remarks) return failure(fmt::format("{}: {}", options.session, remarks.error().message));
  DiagnoseOptions how;
  how.threads = options.threads;
  for (const std::string& name : options.hold) {
    const auto id = find_parameter(name);
    if (!id)
      return failure(
          fmt::format("--hold {}: no parameter of a model; names are as in identify's answer", name));
    how.held.push_back(*id);
  }
  ProgressBar bar("diagnosing");
  how.progress = [&bar](std::string_view what, double share) {
    bar.label(std::string(what));
    bar.show(share);
  };
  Diagnosis diagnosis = diagnose(*session, *model, how);
  diagnosis.remarks.insert(diagnosis.remarks.begin(), remarks->begin(), remarks->end());
  const std::string json = to_json(diagnosis);
  std::vector<NamedText> files{{"diagnosis.json", json},
                               {"model.toml", model_with_intervals(diagnosis)},
                               {"report.html", diagnosis_page(diagnosis, *session, *model).to_html()}};
  if (diagnosis.unexplained)
    files.push_back({"missing_force.csv", missing_force_csv(*diagnosis.unexplained)});
  const auto written = write_files(options.out, files);
  if (!written) return tl::unexpected(written.error());
  std::error_code none_there;
  if (!diagnosis.unexplained)  // that of an earlier run says nothing of this one
    std::filesystem::remove(std::filesystem::path(options.out) / "missing_force.csv", none_there);
  if (options.json) {
    std::fputs(json.c_str(), stdout);
  } else {
    print_summary(diagnosis, options.out);
  }
  return Status::done;
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "diagnose", "Find where a model and recordings differ, and what physics was left out");
  command->footer(
      "Example:\n"
      "  cartwright diagnose --model nominal.toml --session rig/monday --out rig/monday-diagnosis\n"
      "  cartwright evaluate --model rig/monday-diagnosis/model.toml --session rig/tuesday --out /tmp/check");
  auto options = std::make_shared<Options>();
  command->add_option("--model", options->model, "nominal model (TOML)")->required();
  command->add_option("--session", options->session, "directory with session.toml")->required();
  command->add_option("--out", options->out, "directory for diagnosis.json, model.toml and report.html")
      ->required();
  command
      ->add_option(
          "--hold", options->hold,
          "numbers of the nominal model to keep as given, where this session cannot tell them and another "
          "could: voltage_gain_m_per_s2_V, viscous_friction.coefficient_per_s, ...")
      ->delimiter(',');
  command->add_option("--threads", options->threads, "threads to use")
      ->check(CLI::Range(1u, 256u))
      ->capture_default_str();
  command->add_flag("--json", options->json, "print diagnosis.json on standard output");
  on_run(command, exit_status, [options] { return run(*options); });
}

}  // namespace cartwright::cli
