#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/wire/ids.hpp"

namespace cartwright::wire {

/// Counts up with every change of the map that an older client could misread.
inline constexpr std::uint16_t kMapVersion = 2;
inline constexpr std::uint16_t kDefaultPort = 1502;
/// Most registers one Modbus request may read.
inline constexpr std::uint16_t kMostPerRead = 125;

/// How a value lies in its 16-bit registers: most significant register first, IEEE 754 for f32 and f64, and
/// two bytes of UTF-8 per register, padded with zeros, for text (count is then in registers).
enum class Type : std::uint8_t { u16, u32, u64, f32, f64, text };

enum class Access : std::uint8_t {
  read,     ///< anyone may read it
  command,  ///< the client that commands may write it
  select,   ///< anyone may write it; it steers only what this client reads
};

struct Register {
  Id id;
  std::string_view name;  ///< unit last
  std::uint16_t address;  ///< as on the wire, from 0; the same for function codes 3, 4, 6 and 16
  Type type;
  std::uint16_t count;  ///< values of that type, one after the other
  std::string_view unit;
  Access access;
  double least, most, initial;  ///< of what may be written, and what stands there at the start
  std::string_view meaning;

  constexpr std::uint16_t width() const {
    return type == Type::u32 || type == Type::f32 ? 2 : type == Type::u64 || type == Type::f64 ? 4 : 1;
  }
  constexpr std::uint16_t size() const { return static_cast<std::uint16_t>(width() * count); }
  constexpr std::uint16_t end() const { return static_cast<std::uint16_t>(address + size()); }
  constexpr bool writable() const { return access != Access::read; }
};

std::span<const Register, kRegisterCount> registers();
const Register& info(Id id);
std::optional<Id> find_register(std::string_view name);

/// The register that covers an address; none in the gaps between blocks.
const Register* at(std::uint16_t address);

/// First address after the last register.
std::uint16_t map_end();

/// The whole map and every code as Markdown: what README.md of this folder and the man page show.
std::string register_map_markdown();

}  // namespace cartwright::wire
