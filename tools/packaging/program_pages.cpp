#include <cstdio>
#include <memory>
#include <sstream>
#include <vector>

#include "tools/packaging/markdown.hpp"
#include "tools/packaging/pages.hpp"
#include "tools/packaging/roff.hpp"

namespace cartwright::packaging {
namespace {

struct Close {
  void operator()(std::FILE* pipe) const { ::pclose(pipe); }
};

std::string help_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<std::FILE, Close> pipe(::popen((command + " --help").c_str(), "r"));
  char part[4096];
  while (pipe) {
    const std::size_t count = std::fread(part, 1, sizeof part, pipe.get());
    if (count == 0) break;
    text.append(part, count);
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Names under the heading `Subcommands:` of a help text.
std::vector<std::string> subcommands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Subcommands:")) {
      inside = true;
    } else if (!line.starts_with("  ")) {
      inside = false;
    } else if (inside && line.size() > 2 && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

void describe(Page& page, const std::string& program, const std::string& path) {
  const std::string help = help_of(program + path);
  if (!path.empty()) page.subsection("cartwright" + path).verbatim(help);
  for (const std::string& name : subcommands(help)) describe(page, program, path + " " + name);
}

}  // namespace

std::string program_page(const std::string& program) {
  Page page("cartwright", 1, "identify a DC-motor cart, predict it, and find what its model leaves out");
  page.section("SYNOPSIS").paragraph("cartwright COMMAND [OPTIONS]");
  page.section("DESCRIPTION").verbatim(help_of(program));
  page.section("EXIT STATUS")
      .item("0", "done")
      .item("1", "the answer is \"no\": a check failed")
      .item("2",
            "unusable input: one line on standard error says where, what is wrong and what would be right");
  page.paragraph(
      "With --json a command prints one JSON object on standard output and nothing else there. Every "
      "estimated number is {\"value\": v, \"low\": a, \"high\": b}, a 95 % interval with null where the "
      "data gives no bound. Progress goes to standard error, and only to a terminal.");
  page.section("COMMANDS");
  describe(page, program, "");
  page.see_also("cartwrightd(8), cartwright-session(5), cartwright-model(5), cartwright-registers(5)");
  return page.text();
}

std::string daemon_page(const std::string& program, const std::string& readme) {
  Page page("cartwrightd", 8, "the controller of a DC-motor cart");
  page.section("SYNOPSIS").paragraph("cartwrightd --rig FILE [OPTIONS]");
  page.section("DESCRIPTION")
      .paragraph(
          "Runs the control loop at a fixed rate and serves it over Modbus TCP. One client may command at a "
          "time, others may read; cartwright device is one such client. A fault puts zero volts out within "
          "the same tick, stays until it is reset, freezes the log and says in words what happened.")
      .verbatim(help_of(program));
  add_markdown(page, readme, {"States, faults", "An experiment", "The rig file", "Log"});
  page.section("AS A SERVICE")
      .paragraph("The unit cartwrightd.service reads /etc/cartwright/rig.toml and does not start without it:")
      .verbatim(
          "mkdir -p /etc/cartwright\n"
          "cp /usr/share/doc/cartwright/examples/cart.toml /etc/cartwright/\n"
          "cp /usr/share/doc/cartwright/examples/simulated.toml /etc/cartwright/rig.toml\n"
          "systemctl enable --now cartwrightd");
  page.section("EXIT STATUS")
      .item("0", "asked to stop, or the run of --once finished")
      .item("1", "the run of --once ended in a fault")
      .item("2", "unusable rig file, arguments or devices");
  page.see_also("cartwright(1), cartwright-registers(5), cartwright-model(5)");
  return page.text();
}

}  // namespace cartwright::packaging
