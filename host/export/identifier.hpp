#pragma once

#include <string>
#include <vector>

namespace cartwright {

/// MATLAB cuts names after this many characters.
inline constexpr std::size_t kMatlabNameLength = 63;

/// Names that every reader accepts as an identifier (letters, digits and underscores, a letter first, no
/// longer than `longest`), all different, in the order given. Names that already are such identifiers stay as
/// they are.
std::vector<std::string> identifiers(const std::vector<std::string>& names,
                                     std::size_t longest = kMatlabNameLength);

}  // namespace cartwright
