#include "host/report/unit.hpp"

#include <array>
#include <utility>

namespace cartwright::report {
namespace {

/// Longest first: "_m_per_s2" also ends in what could be read as "_s2".
constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kUnits{{
    {"_m_per_s2_V", "m/s²/V"},
    {"_V_s_per_m", "V s/m"},
    {"_rad_per_s", "rad/s"},
    {"_m_per_s2", "m/s²"},
    {"_m_per_s", "m/s"},
    {"_V_per_m", "V/m"},
    {"_s_per_m", "s/m"},
    {"_per_s2", "1/s²"},
    {"_counts", "counts"},
    {"_per_s", "1/s"},
    {"_per_m", "1/m"},
    {"_rad", "rad"},
    {"_hz", "Hz"},
    {"_m", "m"},
    {"_s", "s"},
    {"_V", "V"},
    {"_A", "A"},
}};

const std::pair<std::string_view, std::string_view>* find(std::string_view name) {
  for (const auto& unit : kUnits) {
    if (name.ends_with(unit.first)) return &unit;
  }
  return nullptr;
}

}  // namespace

std::string unit_of(std::string_view name) {
  const auto* unit = find(name);
  return unit ? std::string(unit->second) : "";
}

std::string words_of(std::string_view name) {
  if (const auto* unit = find(name)) name.remove_suffix(unit->first.size());
  std::string out(name);
  for (char& c : out) {
    if (c == '_') c = ' ';
  }
  return out;
}

}  // namespace cartwright::report
