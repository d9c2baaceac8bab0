// Writes one man page to standard output: `manual PAGE [PROGRAM] [README]`.
#include <cstdio>
#include <exception>
#include <fstream>
#include <sstream>
#include <string_view>

#include "tools/packaging/pages.hpp"

namespace {

std::string content(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace cartwright::packaging;
  const std::string_view page = argc > 1 ? argv[1] : "";
  const std::string first = argc > 2 ? argv[2] : "", second = argc > 3 ? argv[3] : "";
  std::string text;
  if (page == "cartwright.1") text = program_page(first);
  if (page == "cartwrightd.8") text = daemon_page(first, content(second));
  if (page == "cartwright-session.5") text = session_page(content(first));
  if (page == "cartwright-model.5") text = model_page();
  if (page == "cartwright-registers.5") text = registers_page(content(first));
  if (text.empty()) {
    std::fprintf(stderr, "manual: no page %s\n", argc > 1 ? argv[1] : "named");
    return 2;
  }
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? 0 : 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "manual: %s\n", error.what());
  return 2;
}
