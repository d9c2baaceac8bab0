#include <gmock/gmock.h>

#include <functional>
#include <sstream>

#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using testing::HasSubstr;

using Words = std::vector<std::string>;

/// The names under "Subcommands:" of a help text.
Words subcommands(const std::string& help) {
  Words names;
  std::istringstream lines(help);
  bool below = false;
  for (std::string line; std::getline(lines, line);) {
    if (below && !line.starts_with("  ")) break;
    // Continuation lines of a description are indented further.
    if (below && line.size() > 2 && line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
    below = below || line == "Subcommands:";
  }
  return names;
}

Finished help(Words path) {
  path.push_back("--help");
  return cartwright(path);
}

void visit(const Words& path, const std::function<void(const Words&, const std::string&)>& see) {
  const Finished finished = help(path);
  ASSERT_EQ(finished.status, 0) << finished.err;
  see(path, finished.out);
  for (const std::string& name : subcommands(finished.out)) {
    Words below = path;
    below.push_back(name);
    visit(below, see);
  }
}

TEST(Help, OfEveryCommandHasExamplesThatNameIt) {
  std::size_t commands = 0;
  visit({}, [&commands](const Words& path, const std::string& text) {
    std::string command = "cartwright";
    for (const std::string& name : path) command += " " + name;
    EXPECT_THAT(text, HasSubstr("Example")) << command;
    EXPECT_THAT(text, HasSubstr("  " + command)) << command;
    ++commands;
  });
  EXPECT_GT(commands, 25u);
}

/// The examples of a command's help, as a user would type them.
Words examples(const std::string& help) {
  Words lines;
  std::istringstream text(help.substr(help.find("Example")));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("  cartwright ")) lines.push_back(line.substr(2));
  }
  return lines;
}

/// Those that need a controller at its usual port, many seconds, or files that only their user has, are left
/// out.
TEST(Help, ExamplesWorkAsTypedAfterABattery) {
  const Scratch scratch;
  const std::string examples_of_the_rig = CARTWRIGHT_EXAMPLES;
  const Finished ready =
      run("/bin/sh",
          {"-c", "cd " + scratch.text("") + " && cp " + examples_of_the_rig +
                     "/* . && cp cart.toml nominal.toml && mkdir rig && " CARTWRIGHTD_PROGRAM
                     " --rig simulated.toml --virtual --once battery --out rig/monday && " CARTWRIGHTD_PROGRAM
                     " --rig simulated.toml --virtual --once step --out rig/monday-gains && "
                     "cp cart.toml sunday.toml"});
  ASSERT_EQ(ready.status, 0) << ready.err;
  std::size_t typed = 0;
  for (const char* command : {"identify", "simulate", "evaluate", "sinefit", "relay-identify", "export",
                              "plot", "report", "design"}) {
    for (const std::string& line : examples(help({command}).out)) {
      const auto says = [&line](const char* words) { return line.find(words) != std::string::npos; };
      if (says("--session emps") || says("cogging") || says("--law pid")) continue;
      const Finished finished = run("/bin/bash", {"-c", "cd " + scratch.text("") + " && cartwright() { " +
                                                            CARTWRIGHT_PROGRAM " \"$@\"; } && " + line});
      EXPECT_EQ(finished.status, 0) << line << "\n" << finished.err;
      ++typed;
    }
  }
  EXPECT_GE(typed, 14u);
}

TEST(Completion, KnowsEveryCommandOfTheHelp) {
  Scratch scratch;
  std::string script = "source <(" CARTWRIGHT_PROGRAM " completion bash)\n";
  std::string expected;
  visit({}, [&](const Words& path, const std::string& text) {
    const Words names = subcommands(text);
    if (names.empty()) return;
    script += "COMP_WORDS=(cartwright";
    for (const std::string& name : path) script += " " + name;
    script += " '')\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_cartwright\necho \"${COMPREPLY[*]}\"\n";
    for (std::size_t i = 0; i < names.size(); ++i) expected += (i > 0 ? " " : "") + names[i];
    expected += "\n";
  });
  script += "COMP_WORDS=(cartwright export --to u); COMP_CWORD=3; _cartwright; echo \"${COMPREPLY[*]}\"\n";
  expected += "ulg\n";
  script += "COMP_WORDS=(cartwright device pull --ou); COMP_CWORD=3; _cartwright; echo \"${COMPREPLY[*]}\"\n";
  expected += "--out\n";
  script += "COMP_WORDS=(cartwright export --out x); COMP_CWORD=3; _cartwright; echo \"${COMPREPLY[*]}\"\n";
  expected += "\n";  // left to bash: a file name
  scratch.put("ask.sh", script);
  const Finished finished = run("bash", {scratch.text("ask.sh")});
  EXPECT_EQ(finished.out, expected) << finished.err;
}

TEST(Doctor, NamesEveryCheckAndTheMendForWhatIsWrong) {
  const Finished plain = cartwright({"doctor"});
  const Finished finished = cartwright({"doctor", "--json"});
  EXPECT_EQ(plain.status, finished.status);
  EXPECT_THAT(finished.out, HasSubstr("\"fine\": " + std::string(finished.status == 0 ? "true" : "false")));
  for (const char* check :
       {"kernel", "real-time priority", "locked memory", "clock resolution", "clock source",
        "processor sleep", "processor speed", "CAN", "GPIO", "controller"}) {
    EXPECT_THAT(plain.out, HasSubstr(check));
  }
}

}  // namespace
}  // namespace cartwright::test
