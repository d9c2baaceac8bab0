#include "host/cli/bash_completion.hpp"

#include <fmt/format.h>

#include <vector>

namespace cartwright::cli {
namespace {

using Words = std::vector<std::string>;

/// The words that a value may be: CLI11 shows them as "{mat,ulg}" in the description of the value's type.
Words choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::string case_line(const std::string& pattern, const Words& words) {
  return fmt::format("    {}) words=\"{}\" ;;\n", pattern, fmt::join(words, " "));
}

/// Collected from a command and all below it. Paths are the commands' names with a slash after each.
struct Tables {
  Words paths;
  std::string values;       ///< per path and option with a value: its choices
  std::string options;      ///< per path: its options
  std::string positionals;  ///< per path: subcommands, or the choices of a positional

  void collect(const CLI::App& command, const std::string& path) {
    paths.push_back(path);
    Words names, words;
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional()) {
        const Words some = choices(*option);
        words.insert(words.end(), some.begin(), some.end());
        continue;
      }
      Words own;
      for (const std::string& name : option->get_lnames()) own.push_back("--" + name);
      for (const std::string& name : option->get_snames()) own.push_back("-" + name);
      if (option->get_expected_min() > 0) {
        for (const std::string& name : own)
          values += case_line(fmt::format("\"{} {}\"", path, name), choices(*option));
      }
      names.insert(names.end(), own.begin(), own.end());
    }
    for (const CLI::App* below : command.get_subcommands({})) words.push_back(below->get_name());
    options += case_line(fmt::format("\"{}\"", path), names);
    if (!words.empty()) positionals += case_line(fmt::format("\"{}\"", path), words);
    for (const CLI::App* below : command.get_subcommands({})) collect(*below, path + below->get_name() + "/");
  }
};

}  // namespace

std::string bash_completion(const CLI::App& app) {
  Tables tables;
  tables.collect(app, "/");
  std::string script = fmt::format(
      "# Completion for {0}; written by `{0} completion bash`.\n"
      "_{0}() {{\n"
      "  local current=\"${{COMP_WORDS[COMP_CWORD]}}\" path=/ words=\"\" i\n"
      "  local known=\" {1} \"\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    [[ $known == *\" $path${{COMP_WORDS[i]}}/ \"* ]] && path+=\"${{COMP_WORDS[i]}}/\"\n"
      "  done\n"
      "  COMPREPLY=()\n"
      "  case \"$path ${{COMP_WORDS[COMP_CWORD - 1]}}\" in\n",
      app.get_name(), fmt::join(tables.paths, " "));
  // An option that takes a value: its choices, or nothing, which leaves file names to bash.
  script += tables.values;
  script +=
      "    *) if [[ $current == -* ]]; then\n"
      "      case \"$path\" in\n" +
      tables.options +
      "      esac\n"
      "    else\n"
      "      case \"$path\" in\n" +
      tables.positionals +
      "      esac\n"
      "    fi ;;\n"
      "  esac\n"
      "  [[ -n $words ]] && COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}\n" +
      fmt::format("complete -o bashdefault -o default -F _{0} {0}\n", app.get_name());
  return script;
}

}  // namespace cartwright::cli
