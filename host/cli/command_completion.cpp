#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "host/cli/bash_completion.hpp"
#include "host/cli/command.hpp"

namespace cartwright::cli {

void add_completion(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("completion", "Print the completion script of a shell");
  command->footer(
      "Examples:\n"
      "  source <(cartwright completion bash)\n"
      "  cartwright completion bash | sudo tee /usr/share/bash-completion/completions/cartwright >/dev/null");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash")->required()->check(CLI::IsMember({"bash"}));
  on_run(command, exit_status, [&app, shell]() -> Outcome {
    fmt::print("{}", bash_completion(app));
    return Status::done;
  });
}

}  // namespace cartwright::cli
