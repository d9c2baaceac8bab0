// Writes one man page to standard output: `manual PAGE [PROGRAM]`.
#include <cstdio>
#include <string_view>

#include "tools/packaging/pages.hpp"

int main(int argc, char** argv) {
  using namespace cartwright::packaging;
  const std::string_view page = argc > 1 ? argv[1] : "";
  const std::string program = argc > 2 ? argv[2] : "";
  std::string text;
  if (page == "cartwright.1" && !program.empty()) text = program_page(program);
  if (page == "cartwrightd.8" && !program.empty()) text = daemon_page(program);
  if (page == "cartwright-session.5") text = session_page();
  if (page == "cartwright-model.5") text = model_page();
  if (page == "cartwright-registers.5") text = registers_page();
  if (text.empty()) {
    std::fprintf(stderr, "manual: no page %s\n", argc > 1 ? argv[1] : "named");
    return 2;
  }
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 2;
}
