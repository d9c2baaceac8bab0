#pragma once

#include <string>
#include <tl/expected.hpp>

namespace cartwright::device {

/// Why the controller did not do what was asked.
enum class Cause {
  unreachable,   ///< nothing answers at that address
  lost,          ///< the connection was there and broke; asking again may help
  refused,       ///< the controller understood, and said no
  incompatible,  ///< what answers is not a controller of this version
};

struct Trouble {
  Cause cause;
  std::string message;  ///< one line: what is wrong, what would be right
};

template <typename T>
using Answer = tl::expected<T, Trouble>;

inline tl::unexpected<Trouble> trouble(Cause cause, std::string message) {
  return tl::unexpected<Trouble>(Trouble{cause, std::move(message)});
}

}  // namespace cartwright::device
