#pragma once

#include <string_view>
#include <vector>

namespace cartwright::report {

/// A file of host/report/assets, compiled in.
struct Asset {
  std::string_view name;
  std::string_view text;
};

/// All of them, in the order in which a page holds them.
const std::vector<Asset>& assets();

}  // namespace cartwright::report
