#pragma once

#include <string>
#include <tl/expected.hpp>

namespace cartwright {

/// What went wrong, in one line a person can act on: where (file, line or key), what is wrong, what would be
/// right.
struct Error {
  std::string message;
};

/// The one way in which a call that can be expected to fail says so.
template <typename T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

}  // namespace cartwright
