#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/wire/codec.hpp"
#include "common/wire/register_map.hpp"

namespace cartwright::device {

/// Registers from `first` to `last` as they were read, and the values in them.
class RegisterBlock {
 public:
  RegisterBlock(wire::Id first, wire::Id last)
      : address_(wire::info(first).address),
        words_(static_cast<std::size_t>(wire::info(last).end() - wire::info(first).address)) {}

  double value(wire::Id id) const { return wire::get(wire::info(id), words_of(id)); }
  std::string text(wire::Id id) const { return wire::get_text(words_of(id)); }
  bool flag(wire::Id id) const { return value(id) != 0; }
  template <typename Integer>
  Integer integer(wire::Id id) const {
    return static_cast<Integer>(value(id));
  }
  /// A code of common/wire/codes.hpp.
  template <typename Code>
  Code code(wire::Id id) const {
    return static_cast<Code>(integer<std::uint16_t>(id));
  }

  std::span<std::uint16_t> words_of(wire::Id id) {
    const wire::Register& what = wire::info(id);
    return std::span(words_).subspan(static_cast<std::size_t>(what.address - address_), what.size());
  }
  std::span<const std::uint16_t> words_of(wire::Id id) const {
    return const_cast<RegisterBlock*>(this)->words_of(id);
  }

 private:
  std::uint16_t address_;
  std::vector<std::uint16_t> words_;
};

}  // namespace cartwright::device
