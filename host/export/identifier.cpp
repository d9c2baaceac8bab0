#include "host/export/identifier.hpp"

#include <fmt/format.h>

#include <set>

namespace cartwright {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::vector<std::string> identifiers(const std::vector<std::string>& names, std::size_t longest) {
  std::vector<std::string> result;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string wanted;
    for (const char c : name) wanted += is_letter(c) || is_digit(c) ? c : '_';
    if (wanted.empty() || !is_letter(wanted.front())) wanted = fmt::format("x_{}", wanted);
    wanted.resize(std::min(wanted.size(), longest));
    std::string unique = wanted;
    for (int copy = 2; !taken.insert(unique).second; ++copy) {
      const std::string suffix = fmt::format("_{}", copy);
      unique = wanted.substr(0, longest - suffix.size()) + suffix;
    }
    result.push_back(std::move(unique));
  }
  return result;
}

}  // namespace cartwright
