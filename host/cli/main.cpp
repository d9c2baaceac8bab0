#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "host/cli/command.hpp"

namespace {

/// The exit status of a program whose output got to where it was sent; a full disk shows only here.
int after_output(int status) {
  const bool failed_before = std::ferror(stdout) != 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !failed_before) return status;
  std::fprintf(stderr, "cartwright: standard output cannot be written: %s\n",
               flushed ? "is the disk full?" : std::strerror(errno));
  return static_cast<int>(cartwright::cli::Status::unusable);
}

/// A word that is no command and no option is told by its name before anything that is missing.
std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string path = "cartwright";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    path += " " + command->get_name();
  }
  const std::string help = "; see " + path + " --help";
  const std::vector<std::string> words = command->remaining();
  if (words.empty()) return error.what() + help;
  const bool option = words.front().starts_with('-');
  if (!option && command->get_require_subcommand_min() == 0) return error.what() + help;
  const std::string missing = (option ? "option " : "command ") + words.front();
  return (command == &app ? "there is no " : command->get_name() + " has no ") + missing + help;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace cartwright::cli;
  CLI::App app{"Cartwright: identify a DC-motor cart, predict it, and find what its model leaves out"};
  app.name("cartwright");
  app.set_version_flag("--version", CARTWRIGHT_VERSION);
  app.footer(
      "Examples:\n"
      "  cartwright device run battery --out rig/monday\n"
      "  cartwright identify --session rig/monday --out model.toml\n"
      "  cartwright evaluate --model model.toml --session rig/monday --out rig/monday-predicted\n"
      "  cartwright doctor\n"
      "cartwright COMMAND --help says more.");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  int exit_status = 0;
  add_completion(app, exit_status);
  add_design(app, exit_status);
  add_diagnose(app, exit_status);
  add_device(app, exit_status);
  add_doctor(app, exit_status);
  add_evaluate(app, exit_status);
  add_identify(app, exit_status);
  add_import(app, exit_status);
  add_export(app, exit_status);
  add_plot(app, exit_status);
  add_relay_identify(app, exit_status);
  add_report(app, exit_status);
  add_reproduce(app, exit_status);
  add_simulate(app, exit_status);
  add_sinefit(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    return after_output(app.exit(request));
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "cartwright: %s\n", what_is_wrong(app, error).c_str());
    return static_cast<int>(Status::unusable);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return after_output(0);
    std::fprintf(stderr, "cartwright: %s\n", error.what());
    return static_cast<int>(Status::unusable);
  }
  return after_output(exit_status);
}
