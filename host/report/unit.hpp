#pragma once

#include <string>
#include <string_view>

namespace cartwright::report {

/// The unit that a name ends in, as people write it: "level_m_per_s2" gives "m/s²"; empty where there is
/// none.
std::string unit_of(std::string_view name);

/// The name without its unit, spaced: "level_m_per_s2" gives "level".
std::string words_of(std::string_view name);

}  // namespace cartwright::report
