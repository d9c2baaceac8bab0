#include "common/wire/codec.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>

namespace cartwright::wire {
namespace {

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
    table[byte] = crc;
  }
  return table;
}
constexpr auto kCrcTable = make_crc_table();

std::uint32_t step(std::uint32_t crc, std::uint32_t byte) noexcept {
  return (crc >> 8U) ^ kCrcTable[(crc ^ byte) & 0xffU];
}

/// The nearest value of an unsigned type; NaN becomes 0.
template <typename Unsigned>
Unsigned rounded(double value) noexcept {
  constexpr double kMost = static_cast<double>(std::numeric_limits<Unsigned>::max());
  if (!(value > 0)) return 0;
  return value >= kMost ? std::numeric_limits<Unsigned>::max() : static_cast<Unsigned>(std::round(value));
}

}  // namespace

void put_u32(std::span<std::uint16_t> to, std::uint32_t value) noexcept {
  to[0] = static_cast<std::uint16_t>(value >> 16U);
  to[1] = static_cast<std::uint16_t>(value & 0xffffU);
}

void put_u64(std::span<std::uint16_t> to, std::uint64_t value) noexcept {
  put_u32(to, static_cast<std::uint32_t>(value >> 32U));
  put_u32(to.subspan(2), static_cast<std::uint32_t>(value & 0xffffffffU));
}

void put_f32(std::span<std::uint16_t> to, float value) noexcept {
  put_u32(to, std::bit_cast<std::uint32_t>(value));
}

void put_f64(std::span<std::uint16_t> to, double value) noexcept {
  put_u64(to, std::bit_cast<std::uint64_t>(value));
}

void put_text(std::span<std::uint16_t> to, std::string_view value) noexcept {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const auto byte = [&](std::size_t at) {
      return at < value.size() ? static_cast<unsigned>(static_cast<unsigned char>(value[at])) : 0U;
    };
    to[i] = static_cast<std::uint16_t>((byte(2 * i) << 8U) | byte(2 * i + 1));
  }
}

std::uint32_t get_u32(std::span<const std::uint16_t> from) noexcept {
  return (static_cast<std::uint32_t>(from[0]) << 16U) | from[1];
}

std::uint64_t get_u64(std::span<const std::uint16_t> from) noexcept {
  return (static_cast<std::uint64_t>(get_u32(from)) << 32U) | get_u32(from.subspan(2));
}

float get_f32(std::span<const std::uint16_t> from) noexcept {
  return std::bit_cast<float>(get_u32(from));
}

double get_f64(std::span<const std::uint16_t> from) noexcept {
  return std::bit_cast<double>(get_u64(from));
}

std::string get_text(std::span<const std::uint16_t> from) {
  std::string text;
  for (const std::uint16_t word : from) {
    for (const unsigned byte : {static_cast<unsigned>(word) >> 8U, word & 0xffU}) {
      if (byte == 0) return text;
      text.push_back(static_cast<char>(byte));
    }
  }
  return text;
}

void put(const Register& what, std::span<std::uint16_t> to, double value) noexcept {
  switch (what.type) {
    case Type::u16:
      to[0] = rounded<std::uint16_t>(value);
      break;
    case Type::u32:
      put_u32(to, rounded<std::uint32_t>(value));
      break;
    case Type::u64:
      put_u64(to, rounded<std::uint64_t>(value));
      break;
    case Type::f32:
      put_f32(to, static_cast<float>(value));
      break;
    case Type::f64:
      put_f64(to, value);
      break;
    case Type::text:
      break;
  }
}

double get(const Register& what, std::span<const std::uint16_t> from) noexcept {
  switch (what.type) {
    case Type::u16:
      return from[0];
    case Type::u32:
      return get_u32(from);
    case Type::u64:
      return static_cast<double>(get_u64(from));
    case Type::f32:
      return widen(get_f32(from));
    case Type::f64:
      return get_f64(from);
    case Type::text:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double widen(float value) noexcept {
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  double wide = static_cast<double>(value);
  std::from_chars(text.data(), written.ptr, wide);
  return wide;
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t crc) noexcept {
  crc = ~crc;
  for (const std::uint8_t byte : bytes) crc = step(crc, byte);
  return ~crc;
}

std::uint32_t crc32(std::span<const std::uint16_t> words) noexcept {
  std::uint32_t crc = ~0U;
  for (const std::uint16_t word : words) crc = step(step(crc, word >> 8U), word & 0xffU);
  return ~crc;
}

}  // namespace cartwright::wire
